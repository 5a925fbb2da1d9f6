#pragma once

#include <cstdio>
#include <string>

#include "cli/data_table.h"

namespace contact::cli {

/// A text as a field of CSV, in quotes where it needs them.
std::string CsvText(const std::string& text);

/// Writes a header line and a line a row; numbers with the digits that give the same double back.
void WriteCsv(const DataTable& table, std::FILE* file);

/// Writes a JSON object a row, keys as the headers of CSV; null for NaN and infinity.
void WriteJsonLines(const DataTable& table, std::FILE* file);

}  // namespace contact::cli
