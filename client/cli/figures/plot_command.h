#pragma once

#include <cstddef>
#include <string>

#include "cli/figures/figure.h"
#include "cli/figures/gnuplot_terminal.h"

namespace contact::cli {

/// The shade of bands, lighter than any curve, as `#rrggbb`.
inline constexpr char kBandShade[] = "#ececec";

/// The command of gnuplot that draws the curves of a panel and its key, in the units x_unit and
/// y_unit. The points of the first curve are in the data block $curve1 after `before` other ones.
/// `crowd` is Figure::crowd.
std::string PlotCommand(const Figure::Panel& panel, std::size_t before, std::size_t crowd,
                        const GnuplotTerminal& terminal);

}  // namespace contact::cli
