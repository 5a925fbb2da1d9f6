#pragma once

#include <string>
#include <string_view>

namespace contact::cli {

/// Text that LaTeX sets as it is: nothing in it becomes a command, and Greek letters are those of
/// its mathematics.
std::string LatexText(std::string_view text);

}  // namespace contact::cli
