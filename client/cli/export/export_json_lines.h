#pragma once

#include <cstdio>

#include "cli/export/data_table.h"

namespace contact::cli {

/// Writes a table as a JSON object a line and row. Keys are the headers of the columns; NaN and
/// infinity, which JSON lacks, are null. `precision` is the number of significant digits; 0 writes
/// as few as give the same double back. Errors of the file show when it is closed.
void WriteJsonLines(const DataTable& table, std::FILE* file, int precision = 0);

}  // namespace contact::cli
