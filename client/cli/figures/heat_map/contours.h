#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cli/figures/gnuplot_terminal.h"
#include "cli/text/sweep/heat_scale.h"

namespace contact::cli {

/// Commands that find lines of equal value in a grid and store them in the data block $contours.
/// `values` has the grid row by row, `columns` of them in a row; no line goes through or beside a
/// NaN. The levels of the lines are round numbers within the scale.
std::string FindContours(const std::vector<double>& values, std::size_t columns,
                         const HeatScale& scale);

/// What `plot` draws of $contours in a grid of this size: the lines, each with its value.
std::string DrawContours(std::size_t rows, std::size_t columns, const GnuplotTerminal& terminal);

/// Round numbers from `low` to `high` for a logarithmic axis, ascending: 1, 2 and 5 of each decade,
/// only 1 of each over more than four decades, and equal steps within one decade. 0 < low < high.
std::vector<double> LogLevels(double low, double high);

}  // namespace contact::cli
