#pragma once

#include <string>

namespace contact::cli {

/// A text as a field of CSV, in quotes where it needs them.
std::string CsvText(const std::string& text);

}  // namespace contact::cli
