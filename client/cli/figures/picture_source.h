#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/export/provenance.h"

namespace contact::cli {

/// Gives a picture that was drawn its title and its sources: SVG as `title` and `desc`, PNG as text
/// chunks Title and Description, PDF as Title and Subject, TikZ as comments, characters as their
/// last line. PDF and TikZ lose the time at which they were made, so that the same run gives the
/// same bytes. Throws Failure (kLocal) if the file cannot be read or written.
void DescribePicture(std::string_view format, const std::string& path, const std::string& title,
                     const std::vector<Provenance>& sources);

}  // namespace contact::cli
