#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "cli/export/data_table.h"
#include "cli/export/provenance.h"
#include "cli/settings/format.h"

namespace contact::cli {

/// Writes one table as text: a header, then a line a row. Numbers have `precision` significant
/// digits, or with 0 as few as give the same double back. `file` stays open.
using TableWriter = void(const DataTable& table, std::FILE* file, int precision);

/// Writes all tables of a result to one file, with units, descriptions and provenance. Throws
/// Failure (kLocal) if the file cannot be written.
using FileWriter = void(const std::vector<DataTable>& tables, const Provenance& provenance,
                        const std::string& path);

/// The writers that formats.def names. Each is defined in a source of this folder, which says how
/// the format represents a table.
#define TABLE_WRITER(enumerator, function) TableWriter function;
#define FILE_WRITER(enumerator, function) FileWriter function;
#include "cli/settings/formats.def"

/// The writer of a format of one table; null for other formats.
TableWriter* TableWriterOf(OutputFormat format);

/// The writer of a format of all tables; null for other formats.
FileWriter* FileWriterOf(OutputFormat format);

}  // namespace contact::cli
