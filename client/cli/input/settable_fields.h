#pragma once

#include <string>
#include <vector>

#include "contact/v1/scenario.pb.h"

namespace contact::cli {

/// A field that `--set` can override.
struct SettableField {
  /// Such as `contacts[0].restitution`.
  std::string path;
  /// The values that an enum or a flag may have; empty for other fields.
  std::vector<std::string> words;
};

/// The fields of a scenario, those of the first entries of each list, by index and by name, and
/// with `[*]` those of all its entries. Parts that a scenario may lack, such as a wall, are there
/// if it has them.
std::vector<SettableField> SettableFields(const v1::Scenario& scenario);

}  // namespace contact::cli
