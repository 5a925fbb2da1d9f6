#pragma once

#include <cstdio>

#include "cli/export/data_table.h"

namespace contact::cli {

/// Writes a table as CSV: a line with the headers of its columns, then a line a row. `precision` is
/// the number of significant digits; 0 writes as few as give the same double back. Errors of the
/// file show when it is closed.
void WriteCsv(const DataTable& table, std::FILE* file, int precision = 0);

}  // namespace contact::cli
