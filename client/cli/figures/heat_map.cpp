#include "cli/figures/heat_map.h"

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

#include "cli/base/failure.h"
#include "cli/base/number.h"
#include "cli/figures/contours.h"
#include "cli/figures/gnuplot.h"

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

// The values through which lines of equal value go, row by row; NaN where none may.
std::vector<double> Converged(const SweepCells& cells, const HeatScale& scale, const Axis& rows,
                              const Axis& columns) {
  std::vector<double> values(rows.size() * columns.size(),
                             std::numeric_limits<double>::quiet_NaN());
  for (const auto& [index, cell] : cells) {
    if (cell.convergence() != v1::Job::FULL) continue;
    values[rows.Place(cell.values(0)) * columns.size() + columns.Place(cell.values(1))] =
        scale.Shown(cell);
  }
  return values;
}

std::string Numbers(const HeatScale& scale, const Medium& medium) {
  const auto [low, high] = Ends(scale);
  return fmt::format(
      ", $cells using 1:2:(sprintf('%.4g', $3)):($3 < {} ? 0xffffff : 0) with labels{} "
      "textcolor rgb variable",
      scale.log() ? std::sqrt(low * high) : (low + high) / 2, medium.Font(9));
}

std::string Legend(const HeatScale& scale) {
  std::string legend = "hatched: not converged; crossed: failed";
  if (scale.unshown() == 0) return legend;
  return legend + fmt::format("; white: {}", Count(scale.unshown(), "value <= 0", "values <= 0"));
}

std::string Axes(const v1::Sweep& sweep, const HeatScale& scale, const Axis& rows,
                 const Axis& columns, const Medium& medium) {
  const auto [low, high] = Ends(scale);
  std::string text = fmt::format(
      "set title {}\nset xlabel {}\nset ylabel {}\nset cblabel {}\n"
      "set xtics out nomirror ({})\nset ytics out nomirror ({})\n"
      "set xrange [-0.5:{}]\nset yrange [{}:-0.5]\nset cbrange [{}:{}]\n"
      "set label {} at screen 0.01,0.015{}\nunset key\n",
      medium.Text(sweep.base().title()), medium.Text(sweep.axes(1).field()),
      medium.Text(sweep.axes(0).field()), medium.Text(sweep.metrics(scale.metric())),
      columns.Tics(), rows.Tics(), static_cast<double>(columns.size()) - 0.5,
      static_cast<double>(rows.size()) - 0.5, low, high, medium.Text(Legend(scale)),
      medium.Font(9));
  if (scale.log()) {
    text += fmt::format("set logscale cb\nset cblabel offset 0.8\nset cbtics ({})\n",
                        fmt::join(LogLevels(low, high), ", "));
  } else if (scale.whole() && high - low < kMostTics) {
    text += "set cbtics 1\n";
  }
  return text;
}

}  // namespace

std::string HeatMapScript(const v1::Job& job, const SweepCells& cells, const HeatScale& scale,
                          bool contours, const Medium& medium, const std::string& path) {
  RequireMap(job.sweep(), cells);
  const Axis rows(cells, 0);
  const Axis columns(cells, 1);
  // One value has no lines, and one row or column has nothing to lie between.
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
  text += fmt::format("0 {} {}\nend\n{}", rows.size() + 1, Ends(scale).first, kPalette);
  if (lines) text += FindContours(Converged(cells, scale, rows, columns), columns.size(), scale);
  text +=
      overlays + Axes(job.sweep(), scale, rows, columns, medium) + medium.Caption({SourceOf(job)});
  // Boxes, as an image would be a bitmap inside.
  text +=
      "set style fill solid noborder\nset style textbox opaque noborder fillcolor rgb 'white' "
      "margins 1.5,1.2\n"
      "plot $cells using 1:2:($1-0.5):($1+0.5):($2-0.5):($2+0.5):3 with boxxyerror lc palette";
  if (lines) {
    text += DrawContours(rows.size(), columns.size(), medium);
  } else if (cells.size() <= kMostNumbers) {
    text += Numbers(scale, medium);
  }
  return text + "\nunset output\n";
}

}  // namespace contact::cli
