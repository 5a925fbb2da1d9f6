#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/provenance.h"

namespace contact::cli {

/// Text of a user as a gnuplot string, which cannot become commands.
std::string GnuplotString(std::string_view text);

/// The terminal that draws svg, png or pdf, eight inches wide. All are the same picture; png has
/// twice the pixels of svg.
std::string GnuplotTerminal(std::string_view format, double height_in);

/// Commands that write where a picture comes from below its last plot; none without sources.
std::string GnuplotCaption(const std::vector<Provenance>& sources);

/// Runs a script file through gnuplot, whose messages go to the standard error. Throws Failure
/// (kLocal) if gnuplot is not installed or fails.
void RunGnuplot(const std::string& script_path);

}  // namespace contact::cli
