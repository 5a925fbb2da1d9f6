#pragma once

#include <cstdio>
#include <string>

#include "cli/data_table.h"

namespace contact::cli {

/// A text as a field of CSV, in quotes where it needs them.
std::string CsvText(const std::string& text);

/// Writes a header line and a line a row; numbers with so many significant digits, or with those
/// that give the same double back, 0.
void WriteCsv(const DataTable& table, std::FILE* file, int precision = 0);

/// Writes a JSON object a row, keys as the headers of CSV; null for NaN and infinity. Numbers as in
/// CSV.
void WriteJsonLines(const DataTable& table, std::FILE* file, int precision = 0);

}  // namespace contact::cli
