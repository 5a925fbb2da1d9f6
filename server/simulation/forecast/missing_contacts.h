#pragma once

#include <vector>

#include "simulation/model/scenario.h"

namespace contact {

/// Neighbours on the line at t = 0 that have no contact between them: of each pair the contact that
/// it lacks, with name, left and right. Left out are pairs that cannot meet, because both are fixed
/// or one of them has a wall on that side, and pairs that overlap from the start or stand at one
/// point: their positions are no places on one line.
std::vector<Contact> MissingContacts(const Scenario& scenario);

}  // namespace contact
