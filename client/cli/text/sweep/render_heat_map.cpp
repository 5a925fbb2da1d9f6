#include "cli/text/sweep/render_heat_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "base/spelling.h"
#include "cli/base/number.h"
#include "cli/text/sweep/sweep_cells.h"
#include "cli/text/sweep/sweep_grid.h"
#include "wire/sweep/axis_words.h"

namespace contact::cli {
namespace {

constexpr std::size_t kMostMapRows = 60;

// The two characters of a cell; null: the cell has not been computed.
std::string Glyph(const v1::SweepCell* cell, const HeatScale& scale, const Style& style) {
  constexpr std::array<std::string_view, 4> kShades{"░", "▒", "▓", "█"};
  if (cell == nullptr) return "··";
  if (cell->state() == v1::Job::FAILED) return Paint("××", Tone::kBad, style);
  const v1::SweepCell::Source source = SourceOf(*cell, scale.metric());
  if (source == v1::SweepCell::CUT) return Paint("][", Tone::kFaint, style);
  if (source == v1::SweepCell::NO_CONTACT) return Paint("()", Tone::kFaint, style);
  const double value = scale.Shown(*cell);
  if (std::isnan(value)) return "--";
  const std::string_view shade =
      kShades[std::min<std::size_t>(3, static_cast<std::size_t>(scale.Height(value) * 4))];
  if (cell->convergence() == v1::Job::FULL) return fmt::format("{0}{0}", shade);
  return Paint(fmt::format("{}!", shade), Tone::kWarning, style);
}

std::string Title(const v1::Sweep& sweep, int metric, const SweepGrid& grid) {
  const v1::Sweep::Axis& across = sweep.axes(1);
  return fmt::format("\n{} over {} (down) and {} (across, {} … {})\n", sweep.metrics(metric),
                     AxisName(sweep.axes(0)), AxisName(across),
                     AxisText(across, grid.columns().front(), 4),
                     AxisText(across, grid.columns().back(), 4));
}

std::string Legend(const HeatScale& scale) {
  std::string legend =
      fmt::format("░ {} … █ {}{};  ! not converged, ×× failed, -- no value", Digits(scale.low(), 5),
                  Digits(scale.high(), 5), scale.log() ? ", log scale" : "");
  if (scale.cut() > 0) legend += ", ][ CUT by the end";
  if (scale.untouched() > 0) legend += ", () no contact";
  if (scale.unshown() == 0) return legend;
  return legend + fmt::format(" ({})", Count(scale.unshown(), "is <= 0", "are <= 0"));
}

}  // namespace

std::string RenderHeatMap(const v1::Sweep& sweep, const SweepCells& cells, int metric,
                          const Style& style, bool log) {
  const std::optional<SweepGrid> grid = SweepGrid::Of(sweep, cells);
  if (!grid || metric < 0 || metric >= sweep.metrics_size()) return "";
  std::vector<std::string> labels;
  for (const double row : grid->rows()) labels.push_back(AxisText(sweep.axes(0), row, 4));
  const int label = Width(*std::ranges::max_element(labels, {}, Width));
  const int width = label + 2 + 3 * static_cast<int>(grid->columns().size());
  if (labels.size() > kMostMapRows || (style.width > 0 && width > style.width)) return "";

  const HeatScale scale(cells, metric, log);
  std::string text = Wrap(Title(sweep, metric, *grid), style);
  for (std::size_t row = 0; row < labels.size(); ++row) {
    text += Pad(labels[row], -label) + " ";
    for (std::size_t column = 0; column < grid->columns().size(); ++column) {
      text.append(" ").append(Glyph(grid->At(row, column), scale, style));
    }
    text += "\n";
  }
  return text + Wrap(Legend(scale) + "\n", style);
}

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
