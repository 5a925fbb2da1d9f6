#pragma once

#include <string>
#include <vector>

#include "cli/export/data_table.h"
#include "cli/export/provenance.h"

namespace contact::cli {

/// Writes a netCDF-4 file (which is HDF5): a group for each table, in it a variable for each
/// column with `units` and `long_name`; the provenance as global attributes. Throws Failure
/// (kLocal) if the file cannot be written.
void WriteNetcdf(const std::vector<DataTable>& tables, const Provenance& provenance,
                 const std::string& path);

}  // namespace contact::cli
