#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "contact/v1/scenario.pb.h"
#include "simulation/model/scenario.h"
#include "wire/rules/rules.h"
#include "wire/scenario/body_codec.h"

namespace contact {

/// Number of contacts after neighbours are expanded: an entry with n > 2 names counts n − 1, one
/// with a play 2.
std::int64_t CountContacts(const v1::Scenario& message);

/// Number of contacts that a valid entry makes: one at a wall, or one for each pair of neighbours;
/// two with a play.
int ContactsOf(const v1::Contact& entry);

/// Name of the contact `number`, from 1 to ContactsOf(entry), of a valid entry.
std::string ContactName(const v1::Contact& entry, int number);

/// Contacts, and what moving walls add: to the physics they are bodies, after those of the
/// scenario.
struct DecodedContacts {
  std::vector<Contact> contacts;
  std::vector<Body> walls;
  std::vector<Drive> drives;  ///< Of the walls.
};

/// Checks the contacts of a scenario and reads them, one for each pair of neighbours. `bodies` are
/// those of the same scenario, `names` finds them. Entries whose bodies are unknown are left out.
DecodedContacts DecodeContacts(const v1::Scenario& message, const std::vector<Body>& bodies,
                               const BodyNames& names, std::vector<Violation>* violations);

}  // namespace contact
