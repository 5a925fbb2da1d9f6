#include "cli/figures/gnuplot.h"

#include <fmt/format.h>

#include <boost/algorithm/string/replace.hpp>
#include <cstdio>
#include <system_error>

#include "cli/base/failure.h"
#include "cli/base/output_file.h"
#include "cli/base/process.h"
#include "cli/base/text_file.h"

namespace contact::cli {
namespace {

// The script is a file that its reader does not know, and is soon gone.
void Repeat(const std::string& said, const std::string& script_path) {
  for (std::string line : LinesOf(said)) {
    boost::replace_all(line, fmt::format("\"{}\" ", script_path), "");
    if (line.find_first_not_of(" \t") != std::string::npos) {
      fmt::print(stderr, "gnuplot: {}\n", line);
    }
  }
}

}  // namespace

void RunGnuplot(const std::string& script_path) {
  const std::string errors_path = script_path + ".errors";
  try {
    OutputFile errors(errors_path);
    const int code = WaitForProcess(StartProcess({"gnuplot", "-d", script_path},  // No settings of
                                                 {.errors = fileno(errors.get())}));  // the user.
    errors.Close();
    Repeat(ReadText(errors_path), script_path);
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
