#pragma once

#include <string>
#include <vector>

#include "cli/base/table.h"
#include "translate/translation.h"

namespace contact::cli {

/// A row for each parameter, and one for each tool that has none; ε and e_N of a tool stand in its
/// first row.
Table TranslationTable(const std::vector<translate::Translation>& translations);

/// Of each tool what to write into its model, and its warnings.
std::string TranslationLines(const std::vector<translate::Translation>& translations);

/// What a tool gives back with given parameters: a row for each of `rebounds`, which have the
/// approach velocities [m/s].
Table ReboundTable(const std::vector<translate::Translation>& rebounds,
                   const std::vector<double>& velocities);

/// All of that as a JSON object: `rebounds`, if a tool's own parameters were given, and
/// `translations`. Numbers have SI units.
std::string TranslationJson(const std::vector<translate::Translation>& rebounds,
                            const std::vector<double>& velocities,
                            const std::vector<translate::Translation>& translations);

}  // namespace contact::cli
