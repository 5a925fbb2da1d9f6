#include "cli/figures/axis_commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace contact::cli {
namespace {

constexpr std::size_t kMostCounted = 20;  // Above it, not every whole number has a tic.

std::size_t Longest(const Figure::Panel& panel) {
  std::size_t longest = 0;
  for (const Figure::Curve& curve : panel.curves) longest = std::max(longest, curve.x.size());
  return longest;
}

// The least and the largest number of an axis; the first is above the second without numbers.
std::pair<double, double> Extent(const Figure::Panel& panel,
                                 std::vector<double> Figure::Curve::*axis) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Figure::Curve& curve : panel.curves) {
    for (const double value : curve.*axis) {
      if (std::isnan(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  return {low, high};
}

// The range of an axis that holds all points; `*` leaves a limit to gnuplot, which fails where all
// points have the same value.
std::string Range(const Figure::Panel& panel, std::vector<double> Figure::Curve::*axis,
                  bool counted, bool log) {
  const auto [low, high] = Extent(panel, axis);
  if (counted) return fmt::format("[{}:{}]", low - 0.5, high + 0.5);
  if (low < high) return "[*:*] noextend";
  if (log) return fmt::format("[{}:{}]", low / 10, high * 10);
  const double space = low == 0 ? 1 : std::abs(low) / 2;
  return fmt::format("[{}:{}]", low - space, low + space);
}

}  // namespace

std::string AxisCommands(const Figure::Panel& panel) {
  const bool whole_tics = panel.counted_x && Longest(panel) <= kMostCounted;
  std::string text = fmt::format(
      "{} logscale y\nset format y '{}'\nset xtics {}\nset xrange {}\nset yrange {}\n",
      panel.log_y ? "set" : "unset", panel.log_y ? "%.0e" : "%g", whole_tics ? "1" : "autofreq",
      Range(panel, &Figure::Curve::x, panel.counted_x, false),
      Range(panel, &Figure::Curve::y, false, panel.log_y));
  if (panel.lowest_y) text += fmt::format("set yrange [{}:*]\n", *panel.lowest_y);
  return text;
}

}  // namespace contact::cli
