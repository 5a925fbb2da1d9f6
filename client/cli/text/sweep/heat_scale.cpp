#include "cli/text/sweep/heat_scale.h"

#include <algorithm>
#include <cmath>

#include "cli/text/sweep/cell_words.h"

namespace contact::cli {

HeatScale::HeatScale(const SweepCells& cells, int metric, bool log) : metric_(metric), log_(log) {
  for (const auto& [index, cell] : cells) {
    const double value = Shown(cell);
    if (std::isnan(value)) {
      if (cell.state() != v1::Job::FAILED) CountHole(cell);
      continue;
    }
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
    whole_ = whole_ && value == std::round(value);
  }
}

void HeatScale::CountHole(const v1::SweepCell& cell) {
  const v1::SweepCell::Source source = SourceOf(cell, metric_);
  if (source == v1::SweepCell::CUT) {
    ++cut_;
  } else if (source == v1::SweepCell::NO_CONTACT) {
    ++untouched_;
  } else {
    ++(std::isfinite(Value(cell)) ? unshown_ : valueless_);
  }
}

double HeatScale::Value(const v1::SweepCell& cell) const {
  const bool has = cell.state() != v1::Job::FAILED && metric_ < cell.metrics_size() &&
                   SourceWord(SourceOf(cell, metric_)).empty();
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
