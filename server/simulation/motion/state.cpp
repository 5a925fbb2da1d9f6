#include "simulation/motion/state.h"

#include <algorithm>
#include <cstddef>

#include "simulation/model/contact_spring.h"
#include "simulation/model/derived.h"
#include "simulation/model/index.h"

namespace contact {

bool IsPacking(const Scenario& scenario) {
  return !scenario.loads.empty() || !scenario.supports.empty() || !scenario.drives.empty() ||
         scenario.contacts.size() >= scenario.bodies.size();
}

bool InCycle(const State& state) {
  return std::ranges::any_of(state.contacts, [](const ContactState& c) {
    return IsRunning(c) || (c.phase == Phase::kStarting && !c.settled);
  });
}

State InitialState(const Scenario& scenario) {
  State state;
  for (const Body& body : scenario.bodies) {
    state.positions.push_back(body.position);
    state.velocities.push_back(body.velocity);
  }
  const auto velocity = [&](int body) {
    return body == kNone ? 0 : scenario.bodies[At(body)].velocity;
  };
  for (const Contact& c : scenario.contacts) {
    ContactState contact;
    contact.gap = InitialGap(scenario, c);
    const double closing = velocity(c.left) - velocity(c.right);
    if (contact.gap < 0) {
      contact.phase = Phase::kStarting;
      contact.cycle.kind = Cycle::Kind::kNirv;
      contact.settled = scenario.starts_at_rest && closing == 0;
      contact.woken = !contact.settled;
      // As if one cycle had pressed it so far.
      contact.largest_work = ElasticEnergy(c, -contact.gap, 0);
    } else if (contact.gap == 0 && closing > 0) {
      contact.phase = Phase::kStarting;
      contact.cycle.kind = Cycle::Kind::kCollision;
    }
    contact.cycle.contact = static_cast<int>(state.contacts.size());
    state.contacts.push_back(contact);
  }
  state.slips.resize(scenario.supports.size());
  return state;
}

}  // namespace contact
