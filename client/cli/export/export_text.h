#pragma once

#include <cstdio>

#include "cli/export/data_table.h"

namespace contact::cli {

/// Writes a header line and a line a row; numbers with so many significant digits, or with those
/// that give the same double back, 0.
void WriteCsv(const DataTable& table, std::FILE* file, int precision = 0);

/// Writes a JSON object a row, keys as the headers of CSV; null for NaN and infinity. Numbers as in
/// CSV.
void WriteJsonLines(const DataTable& table, std::FILE* file, int precision = 0);

}  // namespace contact::cli
