#include "cli/heat_map.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "cli/failure.h"
#include "cli/gnuplot.h"
#include "cli/number.h"

namespace contact::cli {
namespace {

constexpr std::size_t kMostCells = 10'000;
constexpr std::size_t kMostTics = 20;
constexpr std::size_t kMostNumbers = 100;  // More would not be legible in their cells.

// Viridis, which grows evenly lighter, for colour-blind readers too.
constexpr char kPalette[] =
    "set palette defined (0 '#440154', 1 '#472d7b', 2 '#3b528b', 3 '#2c728e', 4 '#21918c', "
    "5 '#28ae80', 6 '#5ec962', 7 '#addc30', 8 '#fde725')\n";

// Values of an axis, with the place of each.
class Axis {
 public:
  Axis(const SweepCells& cells, int axis) {
    for (const auto& [index, cell] : cells) {
      if (places_.try_emplace(cell.values(axis), values_.size()).second) {
        values_.push_back(cell.values(axis));
      }
    }
  }
  std::size_t size() const { return values_.size(); }
  std::size_t Place(double value) const { return places_.at(value); }

  std::string Tics() const {
    const std::size_t step = (size() + kMostTics - 1) / kMostTics;
    std::string tics;
    for (std::size_t i = 0; i < size(); i += step) {
      tics += fmt::format("{}'{}' {}", tics.empty() ? "" : ", ", Digits(values_[i], 4), i);
    }
    return tics;
  }

 private:
  std::vector<double> values_;
  std::map<double, std::size_t> places_;
};

bool Failed(const v1::SweepCell& cell) { return cell.state() == v1::Job::FAILED; }

void RequireMap(const v1::Sweep& sweep, const SweepCells& cells) {
  const bool grid = sweep.combination() == v1::Sweep::GRID ||
                    sweep.combination() == v1::Sweep::COMBINATION_UNSPECIFIED;
  if (!grid || sweep.axes_size() != 2 || cells.empty() || cells.size() > kMostCells) {
    throw Failure(
        ExitCode::kUsage,
        fmt::format("a heat map is of a grid of two axes with at most {} cells", kMostCells));
  }
}

// What lies over a cell: hatching, or a cross on white.
std::string Overlay(const v1::SweepCell& cell, std::size_t x, std::size_t y, bool dark) {
  const double left = static_cast<double>(x) - 0.5;
  const double top = static_cast<double>(y) - 0.5;
  const double right = left + 1;
  const double bottom = top + 1;
  if (!Failed(cell)) {
    if (cell.convergence() == v1::Job::FULL) return "";
    return fmt::format(
        "set object rectangle from {},{} to {},{} front fillcolor rgb '{}' "
        "fillstyle transparent pattern 4 noborder\n",
        left, top, right, bottom, dark ? "white" : "black");
  }
  return fmt::format(
      "set object rectangle from {0},{1} to {2},{3} front fillcolor rgb 'white' fillstyle solid "
      "border lc rgb '#888888'\n"
      "set arrow from {0},{1} to {2},{3} nohead front lc rgb '#b00020' lw 1.5\n"
      "set arrow from {0},{3} to {2},{1} nohead front lc rgb '#b00020' lw 1.5\n",
      left, top, right, bottom);
}

// The ends of the colours, which are apart also for one value, or none.
std::pair<double, double> Ends(const HeatScale& scale) {
  if (scale.low() < scale.high()) return {scale.low(), scale.high()};
  if (scale.log()) {
    const double middle = scale.low() == scale.high() ? scale.low() : 1;
    return {middle / 2, middle * 2};
  }
  const double middle = scale.low() == scale.high() ? scale.low() : 0;
  const double space = std::max(std::abs(middle) / 2, 0.5);
  return {middle - space, middle + space};
}

// About six round numbers between two.
std::vector<double> RoundNumbers(double low, double high) {
  constexpr double kWanted = 6;
  const double decade = std::pow(10, std::floor(std::log10((high - low) / kWanted)));
  double step = decade;
  for (const double part : {2.0, 5.0, 10.0}) {
    if (step * kWanted < high - low) step = part * decade;
  }
  std::vector<double> numbers;
  for (double i = std::ceil(low / step); i * step <= high; ++i) numbers.push_back(i * step);
  return numbers;
}

// On a log scale 1, 2 and 5 of each decade, or 1 of many; round numbers where there is no decade.
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

// Which point of a line of equal value has its label: the middle of one across the shorter side.
std::size_t PlaceOfLabel(const Axis& rows, const Axis& columns) {
  return std::max<std::size_t>(std::min(rows.size(), columns.size()) / 2, 1);
}

// Finds the lines of equal value, through the cells that converged.
std::string FindContours(const SweepCells& cells, const HeatScale& scale, const Axis& rows,
                         const Axis& columns) {
  const std::vector<double> levels =
      scale.log() ? LogLevels(scale.low(), scale.high()) : RoundNumbers(scale.low(), scale.high());
  std::vector<double> values(rows.size() * columns.size(),
                             std::numeric_limits<double>::quiet_NaN());
  for (const auto& [index, cell] : cells) {
    if (cell.convergence() != v1::Job::FULL) continue;
    values[rows.Place(cell.values(0)) * columns.size() + columns.Place(cell.values(1))] =
        scale.Shown(cell);
  }
  std::string text = "$grid << end\n";
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t x = i % columns.size();
    const std::string value = std::isnan(values[i]) ? "NaN" : fmt::to_string(values[i]);
    fmt::format_to(std::back_inserter(text), "{} {} {}\n", x, i / columns.size(), value);
    if (x + 1 == columns.size()) text += '\n';
  }
  return text + fmt::format(
                    "end\nset contour base\nunset surface\n{}set cntrparam levels discrete {}\n"
                    "set xrange [0:{}]\nset yrange [0:{}]\nset zrange [{}:{}]\n"
                    "set table $contours\nsplot $grid using 1:2:3\nunset table\n"
                    // Below the map, so that there is something to draw without lines too.
                    "set print $contours append\nprint ''\n"
                    "do for [i=0:{}] {{ print '0 {} 0' }}\nunset print\n",
                    scale.log() ? "set logscale z\n" : "", fmt::join(levels, ","),
                    columns.size() - 1, rows.size() - 1, scale.low(), scale.high(),
                    PlaceOfLabel(rows, columns), rows.size() + 1);
}

// White on both sides, so that they are seen on every colour; a label on each.
std::string DrawContours(const Axis& rows, const Axis& columns, const Medium& medium) {
  return fmt::format(
      ", $contours using 1:2 with lines lc rgb 'white' lw 2.5"
      ", $contours using 1:2 with lines lc rgb 'black' lw 1"
      ", $contours using 1:2:(sprintf('%.4g', $3)) every 1000000::{} with labels{} "
      "textcolor rgb 'black'{}",
      PlaceOfLabel(rows, columns), medium.tex() ? "" : " boxed", medium.Font(8));
}

std::string Numbers(const HeatScale& scale, const Medium& medium) {
  const auto [low, high] = Ends(scale);
  return fmt::format(
      ", $cells using 1:2:(sprintf('%.4g', $3)):($3 < {} ? 0xffffff : 0) with labels{} "
      "textcolor rgb variable",
      scale.log() ? std::sqrt(low * high) : (low + high) / 2, medium.Font(9));
}

std::string Legend(const HeatScale& scale) {
  const std::string legend = "hatched: not converged; crossed: failed";
  if (scale.unshown() == 0) return legend;
  return legend + fmt::format("; white: {}", Count(scale.unshown(), "value <= 0", "values <= 0"));
}

}  // namespace

std::string HeatMapScript(const v1::Job& job, const SweepCells& cells, const HeatScale& scale,
                          bool contours, const Medium& medium, const std::string& path) {
  const v1::Sweep& sweep = job.sweep();
  RequireMap(sweep, cells);
  const Axis rows(cells, 0);
  const Axis columns(cells, 1);
  const auto [low, high] = Ends(scale);
  // One level has no lines, and one row or column has nothing to lie between.
  const bool lines =
      contours && scale.low() < scale.high() && rows.size() > 1 && columns.size() > 1;
  std::string text =
      fmt::format("{}set encoding utf8\nset terminal {}\nset output {}\n$cells << end\n",
                  Lines({SourceOf(job)}, "# "), medium.Terminal(5), GnuplotString(path));
  std::string overlays;
  for (const auto& [index, cell] : cells) {
    const std::size_t x = columns.Place(cell.values(1));
    const std::size_t y = rows.Place(cell.values(0));
    const double value = scale.Shown(cell);
    if (!std::isnan(value)) fmt::format_to(std::back_inserter(text), "{} {} {}\n", x, y, value);
    overlays += Overlay(cell, x, y, scale.Height(value) < 0.5);
  }
  // Below the map, so that there is something to draw where no cell has a value.
  text += fmt::format("0 {} {}\nend\n{}{}", rows.size() + 1, low, kPalette,
                      lines ? FindContours(cells, scale, rows, columns) : "");
  text += overlays;
  text += fmt::format(
      "set title {}\nset xlabel {}\nset ylabel {}\nset cblabel {}\n"
      "set xtics out nomirror ({})\nset ytics out nomirror ({})\n"
      "set xrange [-0.5:{}]\nset yrange [{}:-0.5]\nset cbrange [{}:{}]\n"
      "set label {} at screen 0.01,0.015{}\n"
      "unset key\n{}",
      medium.Text(sweep.base().title()), medium.Text(sweep.axes(1).field()),
      medium.Text(sweep.axes(0).field()), medium.Text(sweep.metrics(scale.metric())),
      columns.Tics(), rows.Tics(), static_cast<double>(columns.size()) - 0.5,
      static_cast<double>(rows.size()) - 0.5, low, high, medium.Text(Legend(scale)), medium.Font(9),
      medium.Caption({SourceOf(job)}));
  if (scale.log()) {
    text +=
        fmt::format("set logscale cb\nset cbtics ({})\n", fmt::join(LogLevels(low, high), ", "));
  } else if (scale.whole() && high - low < kMostTics) {
    text += "set cbtics 1\n";
  }
  // Boxes, as an image would be a bitmap inside.
  text +=
      "set style fill solid noborder\nset style textbox opaque noborder fillcolor rgb 'white' "
      "margins 1.5,1.2\n"
      "plot $cells using 1:2:($1-0.5):($1+0.5):($2-0.5):($2+0.5):3 with boxxyerror lc palette";
  if (lines) {
    text += DrawContours(rows, columns, medium);
  } else if (cells.size() <= kMostNumbers) {
    text += Numbers(scale, medium);
  }
  return text + "\nunset output\n";
}

}  // namespace contact::cli
