#pragma once

#include <string>

#include "cli/figures/figure.h"

namespace contact::cli {

/// Commands of gnuplot for scale, tics and range of both axes of a panel. The ranges hold all
/// points of its curves; NaN has no place.
std::string AxisCommands(const Figure::Panel& panel);

}  // namespace contact::cli
