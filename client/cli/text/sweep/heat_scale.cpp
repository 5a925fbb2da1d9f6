#include "cli/text/sweep/heat_scale.h"

#include <algorithm>
#include <cmath>

namespace contact::cli {

HeatScale::HeatScale(const SweepCells& cells, int metric, bool log) : metric_(metric), log_(log) {
  for (const auto& [index, cell] : cells) {
    const double value = Shown(cell);
    if (std::isnan(value)) {
      if (cell.state() != v1::Job::FAILED) ++(std::isfinite(Value(cell)) ? unshown_ : valueless_);
      continue;
    }
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
    whole_ = whole_ && value == std::round(value);
  }
}

double HeatScale::Value(const v1::SweepCell& cell) const {
  const bool has = cell.state() != v1::Job::FAILED && metric_ < cell.metrics_size();
  return has ? cell.metrics(metric_) : std::numeric_limits<double>::quiet_NaN();
}

double HeatScale::Shown(const v1::SweepCell& cell) const {
  const double value = Value(cell);
  const bool shown = std::isfinite(value) && (!log_ || value > 0);
  return shown ? value : std::numeric_limits<double>::quiet_NaN();
}

double HeatScale::Height(double value) const {
  if (!(low_ < high_)) return 0;
  return log_ ? std::log(value / low_) / std::log(high_ / low_) : (value - low_) / (high_ - low_);
}

}  // namespace contact::cli
