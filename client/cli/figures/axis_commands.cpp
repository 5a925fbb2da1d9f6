#include "cli/figures/axis_commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace contact::cli {
namespace {

constexpr std::size_t kMostCounted = 20;  // Above it, not every whole number has a tic.

using Axis = std::vector<double> Figure::Curve::*;

std::size_t Longest(const Figure::Panel& panel) {
  std::size_t longest = 0;
  for (const Figure::Curve& curve : panel.curves) longest = std::max(longest, curve.x.size());
  return longest;
}

// The least and the largest number of an axis; the first is above the second without numbers.
struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  double Largest() const { return std::max(std::abs(low), std::abs(high)); }
};

// In units of `unit`. With `log` only numbers above 0 count.
Extent ExtentOf(const Figure::Panel& panel, Axis axis, bool log, double unit) {
  Extent extent;
  for (const Figure::Curve& curve : panel.curves) {
    for (const double value : curve.*axis) {
      if (std::isnan(value) || (log && value <= 0)) continue;
      extent.low = std::min(extent.low, value / unit);
      extent.high = std::max(extent.high, value / unit);
    }
  }
  return extent;
}

// Whole decades, for gnuplot has no number at tics between them.
std::string LogRange(const Extent& extent) {
  if (extent.low == extent.high) return fmt::format("[{}:{}]", extent.low / 10, extent.low * 10);
  return fmt::format("[{}:{}]", std::pow(10, std::floor(std::log10(extent.low))),
                     std::pow(10, std::ceil(std::log10(extent.high))));
}

// Tics of a logarithmic axis at each decade, or at every n-th where there are many.
std::string LogTics(const Extent& extent) {
  constexpr double kMostDecades = 8;
  const double decades = std::log10(extent.high / extent.low);
  if (!(decades > kMostDecades)) return "autofreq";
  return fmt::format("{}", std::pow(10, std::ceil(decades / kMostDecades)));
}

// The range of an axis that holds all points; `*` leaves a limit to gnuplot, which fails where all
// points have the same value.
std::string Range(const Extent& extent, bool counted, bool log) {
  const auto [low, high] = extent;
  if (!(low <= high)) return log ? "[0.1:10]" : "[-1:1]";  // There are no numbers.
  if (counted) return fmt::format("[{}:{}]", low - 0.5, high + 0.5);
  if (log) return LogRange(extent);
  if (low < high) return "[*:*] noextend";
  const double space = low == 0 ? 1 : std::abs(low) / 2;
  return fmt::format("[{}:{}]", low - space, low + space);
}

// How numbers at tics are written: with as many digits as it takes to tell them apart.
std::string Format(const Extent& extent, bool log) {
  constexpr double kPlain = 6;  // Digits of %g.
  if (log) return extent.low < 1e-4 || extent.high >= 1e6 ? "%.0e" : "%g";
  const double span = extent.high - extent.low;
  if (!(span > 0)) return "%g";
  const double digits = std::ceil(std::log10(extent.Largest() / span)) + 3;
  return digits <= kPlain ? "%g" : fmt::format("%.{:.0f}g", std::min(digits, 15.0));
}

AxisUnit Choose(const std::string& label, const Extent& extent, bool log,
                const std::vector<std::string>& named) {
  for (const std::string& unit : named) {
    if (const auto wanted = NamedUnit(label, unit)) return *wanted;
  }
  return log ? AxisUnit{1, label} : ReadableUnit(label, extent.Largest());
}

}  // namespace

PanelUnits UnitsOf(const Figure::Panel& panel, const std::vector<std::string>& named) {
  const Extent x = ExtentOf(panel, &Figure::Curve::x, panel.log_x, 1);
  const Extent y = ExtentOf(panel, &Figure::Curve::y, panel.log_y, 1);
  return {Choose(panel.x_label, x, panel.log_x, named),
          Choose(panel.y_label, y, panel.log_y, named)};
}

std::string AxisCommands(const Figure::Panel& panel, const PanelUnits& units) {
  const Extent x = ExtentOf(panel, &Figure::Curve::x, panel.log_x, units.x.size);
  const Extent y = ExtentOf(panel, &Figure::Curve::y, panel.log_y, units.y.size);
  const bool few =
      Longest(panel) <= kMostCounted && x.high - x.low < static_cast<double>(kMostCounted);
  const auto scale = [](bool log) { return log ? "set" : "unset"; };
  std::string text = fmt::format(
      "{} logscale x\n{} logscale y\nset format x '{}'\nset format y '{}'\nset xtics {}\n"
      "set ytics {}\nset xrange {}\nset yrange {}\n",
      scale(panel.log_x), scale(panel.log_y), Format(x, panel.log_x), Format(y, panel.log_y),
      panel.counted_x && few ? "1" : "autofreq", panel.log_y ? LogTics(y) : "autofreq",
      Range(x, panel.counted_x, panel.log_x), Range(y, false, panel.log_y));
  if (panel.lowest_y) {
    text += fmt::format("set yrange [{}:*]\n", *panel.lowest_y / units.y.size);
  }
  return text;
}

}  // namespace contact::cli
