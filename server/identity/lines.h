#pragma once

#include <functional>
#include <string>

namespace contact {

/// Hands each line of a text on, without its comment, which begins at `#`; lines of which nothing
/// is left are passed over. Stops at the first mistake that `read` returns, and returns it with the
/// number of its line; empty if there is none.
std::string ReadLines(const std::string& text,
                      const std::function<std::string(const std::string&)>& read);

}  // namespace contact
