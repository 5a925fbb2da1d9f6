#pragma once

#include <string>

namespace contact::cli {

/// Runs a script file through gnuplot, whose messages go to the standard error. Throws Failure
/// (kLocal) if gnuplot is not installed or fails.
void RunGnuplot(const std::string& script_path);

}  // namespace contact::cli
