#pragma once

#include <string>

namespace contact {

/// A rule of the contract that a message breaks.
struct Violation {
  /// Path from the message that was checked, such as `contacts[0].restitution` of a scenario.
  std::string field;
  /// Value and rule: `is 1.2; must be in (0, 1]`.
  std::string description;
  /// What to do about it; may be empty.
  std::string hint;
};

}  // namespace contact
