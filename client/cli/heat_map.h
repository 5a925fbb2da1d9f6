#pragma once

#include <string>

#include "cli/gnuplot.h"
#include "cli/render_sweep.h"

namespace contact::cli {

/// A gnuplot script that draws a metric of a sweep over two axes to a file: the first axis down,
/// the second across. Cells that did not converge are hatched, those that failed crossed. Throws
/// Failure (kUsage) unless the sweep is a grid of two axes and at most 10 000 cells.
std::string HeatMapScript(const v1::Job& job, const SweepCells& cells, int metric,
                          const Medium& medium, const std::string& path);

}  // namespace contact::cli
