#pragma once

#include <string>

#include "cli/base/style.h"
#include "cli/text/sweep/cell_words.h"

namespace contact::cli {

/// One metric of a sweep over two axes as shades of two characters a cell: the first axis down, the
/// second across. Cells that did not converge carry a `!`, cells that failed are `××`, those whose
/// value the end of the run cuts `][`, those without its contact `()`. `metric` is its place among
/// the metrics of the sweep. With `log` the shades are of its logarithm. Empty unless the sweep is
/// a grid of two axes that fits into the terminal, and has this metric.
std::string RenderHeatMap(const v1::Sweep& sweep, const SweepCells& cells, int metric,
                          const Style& style, bool log = false);

}  // namespace contact::cli
