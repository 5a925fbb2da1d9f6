#pragma once

#include <string>

namespace contact {

/// A rule of the contract that a message breaks.
struct Violation {
  std::string field;        ///< Path from the scenario, such as `contacts[0].restitution`.
  std::string description;  ///< Value and rule: `is 1.2; must be in (0, 1]`.
  std::string hint;         ///< What to do about it; may be empty.
};

}  // namespace contact
