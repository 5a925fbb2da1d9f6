#pragma once

#include <vector>

#include "simulation/clusters/world.h"
#include "simulation/course/turns.h"

namespace contact {

/// Adds where the channels of bodies turn that no piece moves then, in from < t ≤ to [s]: of those
/// in flight, and of driven ones. All until `to` must be known.
void AddFlightTurns(const World& world, double from, double to, std::vector<Turn>* turns);

}  // namespace contact
