#pragma once

#include <string>
#include <vector>

namespace contact::cli {

/// Names that MATLAB takes for fields, each once: letters, digits and `_`, a letter first, at most
/// 63 of them.
std::vector<std::string> MatlabNames(const std::vector<std::string>& names);

}  // namespace contact::cli
