#pragma once

#include <string>

#include "cli/figures/gnuplot.h"
#include "cli/text/heat_scale.h"

namespace contact::cli {

/// A gnuplot script that draws a metric of a sweep over two axes to a file: the first axis down,
/// the second across. Cells that did not converge are hatched, those that failed crossed; cells
/// without a value are white. `contours` adds lines of equal value, which no such cell has a part
/// in. Throws Failure (kUsage) unless the sweep is a grid of two axes and at most 10 000 cells.
std::string HeatMapScript(const v1::Job& job, const SweepCells& cells, const HeatScale& scale,
                          bool contours, const Medium& medium, const std::string& path);

}  // namespace contact::cli
