#pragma once

#include <google/protobuf/descriptor.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace contact {

/// One step of a path to a field, such as `contacts[0].restitution` or
/// `final_bodies[B1].position_m`.
struct PathStep {
  /// The index that `[*]` means: every entry of a list.
  static constexpr int kEvery = -1;

  /// Name of the field.
  std::string name;
  /// Index in brackets, ≥ 0 or kEvery; none without brackets.
  std::optional<int> index = {};
  /// Text in brackets that is not an index; else empty.
  std::string key = {};
};

/// The steps of a path; empty if `text` is not a path. `keys`: brackets may hold a key instead of
/// an index.
std::vector<PathStep> ParsePath(std::string_view text, bool keys = false);

/// The path of the message that holds the field: `contacts[0]` for `contacts[0].restitution`,
/// empty for a field of the scenario itself.
std::string_view ParentPath(std::string_view path);

/// Hint for a field called `name`, which `message` does not have: how a field follows from it, as
/// from a diameter, the field with the nearest name, or all fields.
std::string FieldHint(const google::protobuf::Descriptor& message, const std::string& name);

}  // namespace contact
