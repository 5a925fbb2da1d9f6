#pragma once

#include <string>

namespace contact::cli {

/// The content of a file; `-` is the standard input. Throws Failure (kLocal) if it cannot be read.
std::string ReadText(const std::string& path);

/// Writes a file, or the standard output for an empty path. Throws Failure (kLocal) if it cannot.
void WriteText(const std::string& text, const std::string& path);

}  // namespace contact::cli
