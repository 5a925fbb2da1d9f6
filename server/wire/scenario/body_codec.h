#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "contact/v1/scenario.pb.h"
#include "simulation/model/scenario.h"
#include "wire/rules/rules.h"

namespace contact {

/// True for a name of a body or contact: letters, digits, '_', '.' and '-', at least one and at
/// most as many as the contract allows for Body.name.
bool IsName(std::string_view text);

/// Notes that the field `name` of a body or contact is not a name.
void BreakName(const std::string& name, const Rules& rules);

/// Checks the bodies of a scenario and reads them, in their order, and their motions into `drives`.
/// The result has as many entries as the message, also if some of them break rules.
std::vector<Body> DecodeBodies(const v1::Scenario& message, std::vector<Drive>* drives,
                               std::vector<Violation>* violations);

/// Finds bodies by name. Of bodies with the same name, finds the first.
class BodyNames {
 public:
  /// `bodies` outlives this and keeps its names.
  explicit BodyNames(const std::vector<Body>& bodies);

  /// Whether a body is called `name`.
  bool Has(std::string_view name) const { return index_.contains(name); }

  /// Index of the body called `name`. If there is none, notes that `field` breaks a rule and
  /// returns kNone.
  int Find(std::string_view name, std::string_view field, const Rules& rules) const;

 private:
  // What to write instead of an unknown name: the nearest one, or all if they are few.
  std::string Hint(std::string_view name) const;

  const std::vector<Body>& bodies_;
  // Index in `bodies_` by name.
  std::unordered_map<std::string_view, int> index_;
};

}  // namespace contact
