#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "cli/export/data_table.h"
#include "cli/export/provenance.h"
#include "cli/link/client.h"
#include "cli/settings/settings.h"

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

/// Waits for the end of a job and writes it to a file as messages of the contract, each after its
/// length as a varint: the Job as GetJob gives it, then every Event as WatchJob gives it, but no
/// bookmarks. Returns how many events. Throws CallFailure, and Failure: kTimeout and kInterrupted
/// when the wait ends first, kLocal if the file cannot be written.
std::int64_t WriteProtobuf(Client& client, const std::string& job, const Settings& settings,
                           const std::string& path);

}  // namespace contact::cli
