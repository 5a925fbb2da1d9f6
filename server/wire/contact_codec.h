#pragma once

#include <vector>

#include "contact/v1/scenario.pb.h"
#include "simulation/model/scenario.h"
#include "wire/body_codec.h"
#include "wire/rules.h"

namespace contact {

/// Contacts after neighbours are expanded.
std::int64_t CountContacts(const v1::Scenario& message);

/// Checks the contacts and reads them, one for each pair of neighbours.
std::vector<Contact> DecodeContacts(const v1::Scenario& message, const std::vector<Body>& bodies,
                                    const BodyNames& names, std::vector<Violation>* violations);

}  // namespace contact
