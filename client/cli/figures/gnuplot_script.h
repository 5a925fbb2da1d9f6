#pragma once

#include <string>

#include "cli/figures/figure.h"
#include "cli/figures/gnuplot_terminal.h"

namespace contact::cli {

/// A gnuplot script that draws a figure to the file `path`. It contains its data, thinned to what
/// a reader can see, and the sources of the figure as comments.
std::string GnuplotScript(Figure figure, const GnuplotTerminal& terminal, const std::string& path);

}  // namespace contact::cli
