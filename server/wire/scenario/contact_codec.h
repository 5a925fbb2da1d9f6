#pragma once

#include <vector>

#include "contact/v1/scenario.pb.h"
#include "simulation/model/scenario.h"
#include "wire/rules/rules.h"
#include "wire/scenario/body_codec.h"

namespace contact {

/// Number of contacts after neighbours are expanded: an entry with n > 2 names counts n − 1.
std::int64_t CountContacts(const v1::Scenario& message);

/// Checks the contacts of a scenario and reads them, one for each pair of neighbours. `bodies` are
/// those of the same scenario, `names` finds them. Entries whose bodies are unknown are left out.
std::vector<Contact> DecodeContacts(const v1::Scenario& message, const std::vector<Body>& bodies,
                                    const BodyNames& names, std::vector<Violation>* violations);

}  // namespace contact
