#include "simulation/clusters/inventory.h"

#include <cmath>

#include "simulation/model/contact_spring.h"

namespace contact {

Inventory InventoryOf(const World& world, double instant) {
  const Scenario& scenario = world.scenario();
  Inventory inventory;
  for (int b = 0; b < std::ssize(scenario.bodies); ++b) {
    if (!world.IsMoved(b)) continue;
    const double mass = scenario.bodies[At(b)].mass, v = world.PlaceOf(b, instant).v;
    inventory.energy += 0.5 * mass * v * v;
    inventory.momentum += mass * v;
    inventory.momentum_scale += mass * std::abs(v);
  }
  for (int c = 0; c < std::ssize(scenario.contacts); ++c) {
    const ContactState& state = world.contacts()[At(c)];
    if (!InTouch(state.phase) && !StartsPressed(state)) continue;
    const double deformation = -world.DistanceAt(c, instant).gap;
    inventory.energy += ElasticEnergy(scenario.contacts[At(c)], deformation, state.yield);
  }
  for (const Support& support : scenario.supports) {
    const double stretch = world.Stretch(support, world.PlaceOf(support.body, instant),
                                         world.PlaceOf(support.other, instant));
    inventory.energy += Spring(support.stiffness, support.higher, stretch).energy;
  }
  return inventory;
}

}  // namespace contact
