#pragma once

#include <google/protobuf/descriptor.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace contact {

/// One step of a path such as `contacts[0].restitution` or `final_bodies[B1].position_m`.
struct PathStep {
  static constexpr int kEvery = -1;  ///< Index of `[*]`.

  std::string name;
  std::optional<int> index = {};
  std::string key = {};  ///< What stands in the brackets if it is no index; or empty.
};

/// Reads a path; empty if it is none. Keys are only read if they may stand there.
std::vector<PathStep> ParsePath(std::string_view text, bool keys = false);

/// The path of the message that holds the field: `contacts[0]` for `contacts[0].restitution`,
/// empty for a field of the scenario itself.
std::string_view ParentPath(std::string_view path);

/// Hint for a field that `message` does not have.
std::string FieldHint(const google::protobuf::Descriptor& message, const std::string& name);

}  // namespace contact
