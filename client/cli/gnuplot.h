#pragma once

#include <string>
#include <string_view>

namespace contact::cli {

/// Text of a user as a gnuplot string, which cannot become commands.
std::string GnuplotString(std::string_view text);

/// Runs a script file through gnuplot, whose messages go to the standard error. Throws Failure
/// (kLocal) if gnuplot is not installed or fails.
void RunGnuplot(const std::string& script_path);

}  // namespace contact::cli
