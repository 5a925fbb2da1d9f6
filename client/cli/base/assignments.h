#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace contact::cli {

/// Reads NAME=VALUE texts into values by name. The first `=` ends the name; the last value of a
/// name counts. Throws Failure (kUsage), which names `flag` and the `expected` form, for a text
/// without a name or without `=`.
std::map<std::string, std::string> ParseAssignments(const std::vector<std::string>& texts,
                                                    std::string_view flag,
                                                    std::string_view expected);

}  // namespace contact::cli
