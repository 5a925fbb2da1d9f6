#pragma once

#include <string>
#include <vector>

#include "cli/export/data_table.h"
#include "cli/export/provenance.h"

namespace contact::cli {

/// Writes a MAT file of version 5: a struct for each table, in it a column vector for each column,
/// words as a cell array; the structs `units`, `descriptions` and `names` tell of each column what
/// the table has, `provenance` where it comes from. Names of columns become valid for MATLAB and
/// stay apart: `B1-B2.contact_force` is `B1_B2_contact_force`. Throws Failure (kLocal) if the file
/// cannot be written.
void WriteMat(const std::vector<DataTable>& tables, const Provenance& provenance,
              const std::string& path);

}  // namespace contact::cli
