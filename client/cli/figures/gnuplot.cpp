#include "cli/figures/gnuplot.h"

#include <system_error>

#include "cli/base/failure.h"
#include "cli/base/process.h"

namespace contact::cli {

void RunGnuplot(const std::string& script_path) {
  try {
    const int code = WaitForProcess(
        StartProcess({"gnuplot", "-d", script_path}));  // -d: no settings of the user.
    if (code != 0) throw Failure(ExitCode::kLocal, "gnuplot failed; what it said stands above");
  } catch (const std::system_error& error) {
    throw Failure(
        ExitCode::kLocal,
        error.code() == std::errc::no_such_file_or_directory
            ? "gnuplot is not installed: apt-get install gnuplot-nox, or use -o gp or -o csv"
            : error.what());
  }
}

}  // namespace contact::cli
