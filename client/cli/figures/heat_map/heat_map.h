#pragma once

#include <string>

#include "cli/figures/gnuplot_terminal.h"
#include "cli/text/sweep/heat_scale.h"

namespace contact::cli {

/// Throws Failure (kUsage) unless the sweep, which breaks no rule, can be drawn: it is a grid of
/// two axes with at most 10 000 cells.
void RequireMap(const v1::Sweep& sweep);

/// A gnuplot script that draws one metric of a sweep over two axes to the file `path`: the first
/// axis down, the second across. Cells that did not converge are hatched, cells that failed are
/// crossed, cells whose value the end of the run cuts are grey with a bar, cells without its
/// contact light grey, cells without a value white. With `contours` it has lines of equal value
/// between the cells that converged. Throws as RequireMap does, and if the sweep has no cell yet.
std::string HeatMapScript(const v1::Job& job, const SweepCells& cells, const HeatScale& scale,
                          bool contours, const GnuplotTerminal& terminal, const std::string& path);

}  // namespace contact::cli
