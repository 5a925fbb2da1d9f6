#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <utility>

namespace contact::cli {

/// Writes a message to the standard error, after all that was written to the standard output so
/// far: also where both go to one file or pipe. The arguments are those of fmt::print.
template <class... Args>
void Tell(fmt::format_string<Args...> text, Args&&... args) {
  std::fflush(stdout);
  fmt::print(stderr, text, std::forward<Args>(args)...);
}

}  // namespace contact::cli
