#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cli/data_table.h"

namespace contact::cli {

/// Global attributes of a file.
using Attributes = std::vector<std::pair<std::string, std::string>>;

/// Writes a netCDF-4 file (which is HDF5): a group for each table, in it a variable for each
/// column with `units` and `long_name`. Throws Failure (kLocal) if the file cannot be written.
void WriteNetcdf(const std::vector<DataTable>& tables, const Attributes& attributes,
                 const std::string& path);

/// What makes a result repeatable: scenario as JSON and its SHA-256, version, revision, job.
Attributes Provenance(const v1::Job& job, const std::string& revision);

}  // namespace contact::cli
