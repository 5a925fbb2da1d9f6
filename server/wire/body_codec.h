#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "contact/v1/scenario.pb.h"
#include "simulation/model/scenario.h"
#include "wire/rules.h"

namespace contact {

/// True for 1 to 64 letters, digits, '_', '.' and '-'.
bool IsName(std::string_view text);

/// Checks the bodies and reads them.
std::vector<Body> DecodeBodies(const v1::Scenario& message, std::vector<Violation>* violations);

/// Finds bodies by name.
class BodyNames {
 public:
  /// `bodies` outlives this.
  explicit BodyNames(const std::vector<Body>& bodies);

  /// Index of the body that `field` names; kNone, and a broken rule, if there is none.
  int Find(std::string_view name, std::string_view field, const Rules& rules) const;

 private:
  std::string Hint(std::string_view name) const;

  const std::vector<Body>& bodies_;
  std::unordered_map<std::string_view, int> index_;
};

}  // namespace contact
