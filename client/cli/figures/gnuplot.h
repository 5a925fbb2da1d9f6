#pragma once

#include <string>

namespace contact::cli {

/// Runs a script file through the program gnuplot and waits for its end. gnuplot writes its
/// messages to the standard error. Throws Failure (kLocal) if gnuplot is not installed or fails.
void RunGnuplot(const std::string& script_path);

}  // namespace contact::cli
