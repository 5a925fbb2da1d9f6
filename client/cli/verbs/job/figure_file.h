#pragma once

#include <string>
#include <vector>

#include "cli/settings/settings.h"

namespace contact::cli {

/// The file of a figure, for verbs that contactsim draws for. All throw Failure (kUsage) for an
/// ending or a format of no figure.

/// The format of a figure by the ending of its file, svg without ending.
OutputFormat FormatOfFigure(const std::string& path);

/// The words that tell contactsim where to draw and how: `file`, or, if that is empty, `name` with
/// the ending of the format that -o names. A txt figure without a file is printed, as wide as the
/// terminal. Throws Failure (kLocal) if the file cannot be written.
std::vector<std::string> FigureWords(const std::string& file, const std::string& name,
                                     const Settings& settings);

}  // namespace contact::cli
