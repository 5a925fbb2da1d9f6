#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cli/figures/gnuplot.h"
#include "cli/text/heat_scale.h"

namespace contact::cli {

/// Lines of equal value over a heat map, as pieces of its script.

/// Finds them through a grid of values, row by row; NaN are left out, and what lies beside them.
std::string FindContours(const std::vector<double>& values, std::size_t columns,
                         const HeatScale& scale);

/// What `plot` draws of them: each with its value.
std::string DrawContours(std::size_t rows, std::size_t columns, const Medium& medium);

/// Round numbers from `low` to `high` on a log scale: 1, 2 and 5 of each decade, 1 of many, and
/// equal steps where there is not one decade. `low` > 0, below `high`.
std::vector<double> LogLevels(double low, double high);

}  // namespace contact::cli
