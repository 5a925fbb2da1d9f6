#include "cli/figures/heat_map/contours.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace contact::cli {
namespace {

// About six round numbers between two, in equal steps.
std::vector<double> RoundNumbers(double low, double high) {
  constexpr double kWanted = 6;
  const double decade = std::pow(10, std::floor(std::log10((high - low) / kWanted)));
  double step = decade;
  for (const double part : {2.0, 5.0, 10.0}) {
    if (step * kWanted < high - low) step = part * decade;
  }
  std::vector<double> numbers;
  for (int i = 0; (std::ceil(low / step) + i) * step <= high; ++i) {
    numbers.push_back((std::ceil(low / step) + i) * step);
  }
  return numbers;
}

// The number of the point of a line that has its label: the middle of a line across the shorter
// side.
std::size_t PlaceOfLabel(std::size_t rows, std::size_t columns) {
  return std::max<std::size_t>(std::min(rows, columns) / 2, 1);
}

}  // namespace

std::vector<double> LogLevels(double low, double high) {
  constexpr double kMostDecades = 4;
  const double decades = std::log10(high / low);
  if (decades < 1) return RoundNumbers(low, high);
  std::vector<double> levels;
  for (int k = static_cast<int>(std::floor(std::log10(low))); std::pow(10, k) <= high; ++k) {
    for (const double part : {1.0, 2.0, 5.0}) {
      const double level = part * std::pow(10, k);
      if (level < low || level > high || (part > 1 && decades > kMostDecades)) continue;
      levels.push_back(level);
    }
  }
  return levels;
}

std::string FindContours(const std::vector<double>& values, std::size_t columns,
                         const HeatScale& scale) {
  const std::size_t rows = values.size() / columns;
  std::string text = "$grid << end\n";
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t x = i % columns;
    const std::string value = std::isnan(values[i]) ? "NaN" : fmt::to_string(values[i]);
    fmt::format_to(std::back_inserter(text), "{} {} {}\n", x, i / columns, value);
    if (x + 1 == columns) text += '\n';
  }
  const auto levels = (scale.log() ? LogLevels : RoundNumbers)(scale.low(), scale.high());
  text += fmt::format(
      "end\nset contour base\nunset surface\n{}set cntrparam levels discrete {}\n"
      "set xrange [0:{}]\nset yrange [0:{}]\nset zrange [{}:{}]\n"
      "set table $contours\nsplot $grid using 1:2:3\nunset table\n",
      scale.log() ? "set logscale z\n" : "", fmt::join(levels, ","), columns - 1, rows - 1,
      scale.low(), scale.high());
  // One point below the map, so that there is something to draw without lines.
  return text + fmt::format(
                    "set print $contours append\nprint ''\ndo for [i=0:{}] {{ print '0 {} 0' }}\n"
                    "unset print\n",
                    PlaceOfLabel(rows, columns), rows + 1);
}

// White on both sides of each line, so that it is seen on every colour.
std::string DrawContours(std::size_t rows, std::size_t columns, const GnuplotTerminal& terminal) {
  return fmt::format(
      ", $contours using 1:2 with lines lc rgb 'white' lw 2.5"
      ", $contours using 1:2 with lines lc rgb 'black' lw 1"
      ", $contours using 1:2:(sprintf('%.4g', $3)) every 1000000::{} with labels{} "
      "textcolor rgb 'black'{}",
      PlaceOfLabel(rows, columns), terminal.tex() ? "" : " boxed", terminal.Font(8));
}

}  // namespace contact::cli
