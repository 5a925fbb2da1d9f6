#include "cli/heat_map.h"

#include <fmt/format.h>

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

double MetricOf(const v1::SweepCell& cell, int metric) {
  const bool has = !Failed(cell) && metric < cell.metrics_size();
  return has ? cell.metrics(metric) : std::numeric_limits<double>::quiet_NaN();
}

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

struct Scale {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  bool whole = true;  // All values are whole numbers.

  Scale(const SweepCells& cells, int metric) {
    for (const auto& [index, cell] : cells) {
      const double value = MetricOf(cell, metric);
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
      whole = whole && value == std::round(value);
    }
    if (low < high) return;
    const double middle = low == high ? low : 0;  // One value, or none.
    low = middle - std::max(std::abs(middle) / 2, 0.5);
    high = middle + std::max(std::abs(middle) / 2, 0.5);
  }
};

}  // namespace

std::string HeatMapScript(const v1::Job& job, const SweepCells& cells, int metric,
                          const Medium& medium, const std::string& path) {
  const v1::Sweep& sweep = job.sweep();
  RequireMap(sweep, cells);
  const Axis rows(cells, 0);
  const Axis columns(cells, 1);
  std::string text =
      fmt::format("{}set encoding utf8\nset terminal {}\nset output {}\n$cells << end\n",
                  Lines({SourceOf(job)}, "# "), medium.Terminal(5), GnuplotString(path));
  std::string overlays;
  const Scale scale(cells, metric);
  for (const auto& [index, cell] : cells) {
    const std::size_t x = columns.Place(cell.values(1));
    const std::size_t y = rows.Place(cell.values(0));
    const double value = MetricOf(cell, metric);
    if (std::isfinite(value)) fmt::format_to(std::back_inserter(text), "{} {} {}\n", x, y, value);
    overlays += Overlay(cell, x, y, value < (scale.low + scale.high) / 2);
  }
  // Below the map, so that there is something to draw where no cell has a value.
  text += fmt::format("0 {} 0\nend\n{}{}", rows.size() + 1, kPalette, overlays);
  text += fmt::format(
      "set title {}\nset xlabel {}\nset ylabel {}\nset cblabel {}\n"
      "set xtics out nomirror ({})\nset ytics out nomirror ({})\n"
      "set xrange [-0.5:{}]\nset yrange [{}:-0.5]\nset cbrange [{}:{}]\n"
      "set label 'hatched: not converged; crossed: failed' at screen 0.01,0.015{}\n"
      "unset key\n{}",
      medium.Text(sweep.base().title()), medium.Text(sweep.axes(1).field()),
      medium.Text(sweep.axes(0).field()), medium.Text(sweep.metrics(metric)), columns.Tics(),
      rows.Tics(), static_cast<double>(columns.size()) - 0.5,
      static_cast<double>(rows.size()) - 0.5, scale.low, scale.high, medium.Font(9),
      medium.Caption({SourceOf(job)}));
  if (scale.whole && scale.high - scale.low < kMostTics) text += "set cbtics 1\n";
  // Boxes, as an image would be a bitmap inside.
  text +=
      "set style fill solid noborder\n"
      "plot $cells using 1:2:($1-0.5):($1+0.5):($2-0.5):($2+0.5):3 with boxxyerror lc palette";
  if (cells.size() <= kMostNumbers) {
    text += fmt::format(
        ", $cells using 1:2:(sprintf('%.4g', $3)):($3 < {} ? 0xffffff : 0) with labels{} "
        "textcolor rgb variable",
        (scale.low + scale.high) / 2, medium.Font(9));
  }
  return text + "\nunset output\n";
}

}  // namespace contact::cli
