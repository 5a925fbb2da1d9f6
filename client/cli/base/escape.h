#pragma once

#include <string>
#include <string_view>

namespace contact::cli {

/// A text of a user or a server as LaTeX sets it: no character of it becomes a command. Greek
/// letters and the few other signs of our units become commands of its mathematics. Characters that
/// are not printable (UnprintableBytes) become spaces, but ends of lines stay.
std::string LatexText(std::string_view text);

}  // namespace contact::cli
