#include "cli/export/matlab_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

namespace contact::cli {
namespace {

// Whatever the locale.
bool IsLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool IsDigit(char c) { return c >= '0' && c <= '9'; }

std::string Valid(const std::string& name) {
  std::string valid = name;
  std::ranges::replace_if(
      valid, [](char c) { return !IsLetter(c) && !IsDigit(c); }, '_');
  return !valid.empty() && IsLetter(valid[0]) ? valid : fmt::format("x{}", valid);
}

}  // namespace

std::vector<std::string> MatlabNames(const std::vector<std::string>& names) {
  constexpr std::size_t kLongest = 63;
  std::vector<std::string> valid;
  valid.reserve(names.size());
  std::set<std::string> used;
  for (const std::string& name : names) {
    const std::string stem = Valid(name);
    std::string unique = stem.substr(0, kLongest);
    for (int number = 2; !used.insert(unique).second; ++number) {
      const std::string suffix = fmt::format("_{}", number);
      unique = stem.substr(0, kLongest - suffix.size()) + suffix;
    }
    valid.push_back(std::move(unique));
  }
  return valid;
}

}  // namespace contact::cli
