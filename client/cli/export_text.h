#pragma once

#include <cstdio>

#include "cli/data_table.h"

namespace contact::cli {

/// Writes a header line and a line a row; numbers with the digits that give the same double back.
void WriteCsv(const DataTable& table, std::FILE* file);

/// Writes a JSON object a row, keys as the headers of CSV; null for NaN and infinity.
void WriteJsonLines(const DataTable& table, std::FILE* file);

}  // namespace contact::cli
