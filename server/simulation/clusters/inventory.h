#pragma once

#include "simulation/clusters/world.h"

namespace contact {

/// What a world holds at an instant, (B1) and (B2).
struct Inventory {
  double energy = 0;          ///< Kinetic, of contacts in touch, and of supports [J].
  double momentum = 0;        ///< Of what moves [N·s],
  double momentum_scale = 0;  ///< and the sum of the magnitudes [N·s].
};

Inventory InventoryOf(const World& world, double instant);

}  // namespace contact
