#pragma once

#include <string>
#include <vector>

#include "cli/export/data_table.h"
#include "cli/export/provenance.h"

namespace contact::cli {

/// Writes PATH-metadata.json beside a CSV file, which itself has no place for it: units and
/// descriptions of the columns, and where they come from, as the W3C's "CSV on the Web" has it.
/// Throws Failure (kLocal) if it cannot be written.
void WriteCsvMetadata(const std::vector<DataColumn>& columns,
                      const std::vector<Provenance>& sources, const std::string& path);

}  // namespace contact::cli
