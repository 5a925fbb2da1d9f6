#pragma once

#include <string>

namespace contact::cli {

/// The content of a file; `-` is the standard input. Throws Failure (kLocal) if it cannot be read.
std::string ReadText(const std::string& path);

}  // namespace contact::cli
