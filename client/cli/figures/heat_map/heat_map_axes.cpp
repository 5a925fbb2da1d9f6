#include "cli/figures/heat_map/heat_map_axes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/spelling.h"
#include "cli/base/number.h"
#include "cli/figures/heat_map/contours.h"
#include "cli/text/sweep/axis_text.h"
#include "cli/text/sweep/sweep_labels.h"

namespace contact::cli {
namespace {

constexpr std::size_t kMostTics = 20;    // Of an axis that points down, and of colours.
constexpr std::size_t kCharacters = 64;  // That stand beside each other below an axis.

// A number of cells between two tics that people count in, at least this.
std::size_t RoundStep(std::size_t least) {
  for (std::size_t decade = 1;; decade *= 10) {
    for (const std::size_t part : {1U, 2U, 5U}) {
      if (part * decade >= least) return part * decade;
    }
  }
}

// The list of tics of an axis: value and place, every n-th where there is no room for all.
std::string Tics(const v1::Sweep::Axis& axis, const std::vector<double>& values, bool across,
                 const GnuplotTerminal& terminal) {
  constexpr std::size_t kSpace = 2;  // Between two values.
  std::vector<std::string> texts;
  std::size_t longest = 0;
  for (const double value : values) {
    texts.push_back(AxisText(axis, value, 4));
    longest = std::max(longest, texts.back().size());
  }
  const std::size_t most = across ? kCharacters / (longest + kSpace) : kMostTics;
  const std::size_t step = RoundStep((values.size() + most - 1) / most);
  std::vector<std::string> tics;
  for (std::size_t i = 0; i < values.size(); i += step) {
    tics.push_back(fmt::format("{} {}", terminal.Text(texts[i]), i));
  }
  return fmt::format("{}", fmt::join(tics, ", "));
}

std::string Legend(const HeatScale& scale) {
  std::vector<std::string> white;
  if (scale.unshown() > 0) white.push_back(Count(scale.unshown(), "value <= 0", "values <= 0"));
  if (scale.valueless() > 0)
    white.push_back(Count(scale.valueless(), "without value", "without value"));
  std::string legend = "hatched: not converged; crossed: failed";
  if (scale.cut() > 0) legend += "; grey with a bar: CUT by the end";
  if (scale.untouched() > 0) legend += "; light grey: no contact";
  return white.empty() ? legend : fmt::format("{}; white: {}", legend, fmt::join(white, ", "));
}

std::string ColourTics(const HeatScale& scale, const ColourRange& range) {
  if (scale.log()) {
    return fmt::format("set logscale cb\nset cblabel offset 0.8\nset cbtics ({})\n",
                       fmt::join(LogLevels(range.low, range.high), ", "));
  }
  const bool few = range.high - range.low < static_cast<double>(kMostTics);
  return scale.whole() && few ? "set cbtics 1\n" : "";
}

}  // namespace

ColourRange::ColourRange(const HeatScale& scale) : low(scale.low()), high(scale.high()) {
  if (low < high) return;
  const bool one = low == high;
  if (scale.log()) {
    const double middle = one ? low : 1;
    low = middle / 2;
    high = middle * 2;
  } else {
    const double middle = one ? low : 0;
    const double space = std::max(std::abs(middle) / 2, 0.5);
    low = middle - space;
    high = middle + space;
  }
}

std::string HeatMapAxes(const v1::Sweep& sweep, const HeatScale& scale, const SweepGrid& grid,
                        const GnuplotTerminal& terminal) {
  const ColourRange range(scale);
  return fmt::format(
             "set title {}\nset xlabel {}\nset ylabel {}\nset cblabel {}\n"
             "set xtics out nomirror ({})\nset ytics out nomirror ({})\n"
             "set xrange [-0.5:{}]\nset yrange [{}:-0.5]\nset cbrange [{}:{}]\n"
             "set label {} at screen 0.01,0.015{}\nunset key\n",
             terminal.Text(sweep.base().title()), terminal.Text(AxisLabel(sweep, 1)),
             terminal.Text(AxisLabel(sweep, 0)),
             terminal.Text(MetricLabel(sweep.metrics(scale.metric()))),
             Tics(sweep.axes(1), grid.columns(), true, terminal),
             Tics(sweep.axes(0), grid.rows(), false, terminal),
             static_cast<double>(grid.columns().size()) - 0.5,
             static_cast<double>(grid.rows().size()) - 0.5, range.low, range.high,
             terminal.Text(Legend(scale)), terminal.Font(9)) +
         ColourTics(scale, range);
}

}  // namespace contact::cli
