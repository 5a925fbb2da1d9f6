#pragma once

#include <string>

namespace contact::cli {

/// Runs a script file through the program gnuplot and waits for its end. Repeats what gnuplot says
/// on the standard error, without the path of the script, and writes a file beside the script for
/// that. Throws Failure (kLocal) if gnuplot is not installed or fails.
void RunGnuplot(const std::string& script_path);

}  // namespace contact::cli
