#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

#include "base/spelling.h"

namespace contact::cli {

/// Writes a message to the standard error, after all that was written to the standard output so
/// far: also where both go to one file or pipe. The arguments are those of fmt::format; what steers
/// a terminal is replaced, as it may come from a server or a file.
template <class... Args>
void Tell(fmt::format_string<Args...> text, Args&&... args) {
  std::fflush(stdout);
  std::fputs(PrintableLines(fmt::format(text, std::forward<Args>(args)...)).c_str(), stderr);
}

}  // namespace contact::cli
