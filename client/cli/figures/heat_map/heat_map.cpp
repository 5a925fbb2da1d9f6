#include "cli/figures/heat_map/heat_map.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <vector>

#include "cli/base/failure.h"
#include "cli/base/number.h"
#include "cli/figures/heat_map/contours.h"
#include "cli/figures/heat_map/heat_map_axes.h"
#include "cli/input/no_limits.h"
#include "cli/text/sweep/cell_words.h"
#include "cli/text/sweep/sweep_grid.h"
#include "wire/sweep/sweep_codec.h"

namespace contact::cli {
namespace {

constexpr std::size_t kMostCells = 10'000;
constexpr std::size_t kMostNumbers = 100;  // More would not be legible in their cells.

// Viridis, which grows evenly lighter, for colour-blind readers too.
constexpr char kPalette[] =
    "set palette defined (0 '#440154', 1 '#472d7b', 2 '#3b528b', 3 '#2c728e', 4 '#21918c', "
    "5 '#28ae80', 6 '#5ec962', 7 '#addc30', 8 '#fde725')\n";

[[noreturn]] void Refuse() {
  throw Failure(
      ExitCode::kUsage,
      fmt::format("a heat map is of a grid of two axes with at most {} cells", kMostCells));
}

SweepGrid RequireGrid(const v1::Sweep& sweep, const SweepCells& cells) {
  const std::optional<SweepGrid> grid = SweepGrid::Of(sweep, cells);
  if (!grid || cells.size() > kMostCells) Refuse();
  return *grid;
}

// A grey cell whose left upper corner is (left, top); with a bar if the end of the run cuts its
// value, which else no contact has.
std::string GreyCell(double left, double top, bool cut) {
  std::string text = fmt::format(
      "set object rectangle from {},{} to {},{} front fillcolor rgb '{}' fillstyle solid "
      "noborder\n",
      left, top, left + 1, top + 1, cut ? "#b0b0b0" : "#e8e8e8");
  if (!cut) return text;
  return text +
         fmt::format("set arrow from {0},{1} to {0},{2} nohead front lc rgb 'black' lw 1.5\n",
                     left + 0.5, top, top + 1);
}

// What lies over a cell whose centre is (x, y): hatching, a cross on white, or grey.
std::string Overlay(const v1::SweepCell& cell, v1::SweepCell::Source source, std::size_t x,
                    std::size_t y, bool dark) {
  const double left = static_cast<double>(x) - 0.5;
  const double top = static_cast<double>(y) - 0.5;
  if (cell.state() == v1::Job::FAILED) {
    return fmt::format(
        "set object rectangle from {0},{1} to {2},{3} front fillcolor rgb 'white' fillstyle solid "
        "border lc rgb '#888888'\n"
        "set arrow from {0},{1} to {2},{3} nohead front lc rgb '#b00020' lw 1.5\n"
        "set arrow from {0},{3} to {2},{1} nohead front lc rgb '#b00020' lw 1.5\n",
        left, top, left + 1, top + 1);
  }
  if (!SourceWord(source).empty()) return GreyCell(left, top, source == v1::SweepCell::CUT);
  if (cell.convergence() == v1::Job::FULL) return "";
  return fmt::format(
      "set object rectangle from {},{} to {},{} front fillcolor rgb '{}' "
      "fillstyle transparent pattern 4 noborder\n",
      left, top, left + 1, top + 1, dark ? "white" : "black");
}

std::string Overlays(const SweepGrid& grid, const SweepCells& cells, const HeatScale& scale) {
  std::string overlays;
  for (const auto& [index, cell] : cells) {
    overlays += Overlay(cell, SourceOf(cell, scale.metric()), grid.ColumnOf(cell), grid.RowOf(cell),
                        scale.Height(scale.Shown(cell)) < 0.5);
  }
  return overlays;
}

// The data block of all cells that have a value: column, row, value. One more row lies below the
// map, so that there is something to draw where no cell has a value.
std::string CellData(const SweepGrid& grid, const SweepCells& cells, const HeatScale& scale) {
  std::string text = "$cells << end\n";
  for (const auto& [index, cell] : cells) {
    const double value = scale.Shown(cell);
    if (std::isnan(value)) continue;
    fmt::format_to(std::back_inserter(text), "{} {} {}\n", grid.ColumnOf(cell), grid.RowOf(cell),
                   value);
  }
  return text + fmt::format("0 {} {}\nend\n", grid.rows().size() + 1, ColourRange(scale).low);
}

// The values between which lines of equal value go, row by row; NaN where no line may go.
std::vector<double> Converged(const SweepGrid& grid, const SweepCells& cells,
                              const HeatScale& scale) {
  std::vector<double> values(grid.rows().size() * grid.columns().size(),
                             std::numeric_limits<double>::quiet_NaN());
  for (const auto& [index, cell] : cells) {
    if (cell.convergence() != v1::Job::FULL) continue;
    values[grid.RowOf(cell) * grid.columns().size() + grid.ColumnOf(cell)] = scale.Shown(cell);
  }
  return values;
}

// What `plot` draws of the numbers in the cells, white on dark colours.
std::string Numbers(const HeatScale& scale, const GnuplotTerminal& terminal) {
  const auto [low, high] = ColourRange(scale);
  return fmt::format(
      ", $cells using 1:2:(sprintf('%.4g', $3)):($3 < {} ? 0xffffff : 0) with labels{} "
      "textcolor rgb variable",
      scale.log() ? std::sqrt(low * high) : (low + high) / 2, terminal.Font(9));
}

}  // namespace

void RequireMap(const v1::Sweep& sweep) {
  if (!SweepGrid::IsGrid(sweep)) Refuse();
  const std::int32_t cells = DecodeSweep(sweep, kNoLimits).axes.cells();
  if (cells > static_cast<std::int32_t>(kMostCells)) Refuse();
}

std::string HeatMapScript(const v1::Job& job, const SweepCells& cells, const HeatScale& scale,
                          bool contours, const GnuplotTerminal& terminal, const std::string& path) {
  const SweepGrid grid = RequireGrid(job.sweep(), cells);
  const std::size_t rows = grid.rows().size();
  const std::size_t columns = grid.columns().size();
  // Neither one value nor one row or column has lines.
  const bool lines = contours && scale.low() < scale.high() && rows > 1 && columns > 1;
  std::string text =
      fmt::format("{}set encoding utf8\nset terminal {}\nset output {}\n",
                  Lines({SourceOf(job)}, "# "), terminal.Terminal(5), GnuplotString(path));
  text += CellData(grid, cells, scale) + kPalette;
  if (lines) text += FindContours(Converged(grid, cells, scale), columns, scale);
  text += Overlays(grid, cells, scale) + HeatMapAxes(job.sweep(), scale, grid, terminal) +
          terminal.CaptionCommands({SourceOf(job)});
  // Boxes keep the map a vector drawing, where `with image` would embed a bitmap. They overlap, for
  // else the background shines through between them.
  text +=
      "set style fill solid noborder\nset style textbox opaque noborder fillcolor rgb 'white' "
      "margins 1.5,1.2\n"
      "plot $cells using 1:2:($1-0.5):($1+0.52):($2-0.5):($2+0.52):3 with boxxyerror lc palette";
  if (lines) {
    text += DrawContours(rows, columns, terminal);
  } else if (cells.size() <= kMostNumbers) {
    text += Numbers(scale, terminal);
  }
  return text + "\nunset output\n";
}

}  // namespace contact::cli
