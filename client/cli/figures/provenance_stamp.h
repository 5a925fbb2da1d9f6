#pragma once

#include <string>
#include <vector>

#include "cli/export/provenance.h"
#include "cli/settings/format.h"

namespace contact::cli {

/// Writes title and sources into a file that gnuplot has drawn: SVG has them as `title` and `desc`,
/// PNG as text chunks Title and Description, PDF as Title and Subject, TikZ has the sources as
/// comments, txt has them as its last line. Removes from PDF and TikZ the time of drawing, so that
/// the same run gives the same bytes. Throws Failure (kLocal) if the file cannot be read or
/// written.
void StampProvenance(OutputFormat format, const std::string& path, const std::string& title,
                     const std::vector<Provenance>& sources);

}  // namespace contact::cli
