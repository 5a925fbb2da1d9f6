#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace contact::cli {

/// The whole content of a file, any bytes; `-` is the standard input. Throws Failure (kLocal) if it
/// cannot be read, or has more bytes than `most`.
std::string ReadText(const std::string& path,
                     std::size_t most = std::numeric_limits<std::size_t>::max());

/// Replaces the content of a file; an empty path is the standard output. Throws Failure (kLocal) if
/// it cannot be written.
void WriteText(const std::string& text, const std::string& path);

/// The lines of a text without their ends. A last line without an end is one, too.
std::vector<std::string> LinesOf(const std::string& text);

}  // namespace contact::cli
