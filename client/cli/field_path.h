#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace contact::cli {

/// One step of a path such as `contacts[0].restitution`.
struct PathStep {
  static constexpr int kEvery = -1;  ///< Index of `[*]`.

  std::string name;
  std::optional<int> index;
};

/// Reads a path; empty if it is none.
std::vector<PathStep> ParsePath(std::string_view text);

/// The path of the message that holds the field: `contacts[0]` for `contacts[0].restitution`,
/// empty for a field of the scenario itself.
std::string_view ParentPath(std::string_view path);

}  // namespace contact::cli
