#pragma once

#include <string>

#include "cli/figures/gnuplot_terminal.h"
#include "cli/text/sweep/heat_scale.h"
#include "cli/text/sweep/sweep_grid.h"

namespace contact::cli {

/// The two ends of the colour axis of a heat map, in the unit of its metric; low < high.
struct ColourRange {
  /// The range of the scale, widened where the scale has one value or none.
  explicit ColourRange(const HeatScale& scale);

  double low;
  double high;
};

/// Commands for title, axes, tics, colour axis and legend of a heat map. The centre of the cell in
/// row r and column c is the point (c, r); y points down.
std::string HeatMapAxes(const v1::Sweep& sweep, const HeatScale& scale, const SweepGrid& grid,
                        const GnuplotTerminal& terminal);

}  // namespace contact::cli
