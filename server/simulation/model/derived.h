#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "simulation/model/scenario.h"

namespace contact {

// What follows from a scenario at once.

/// The distance of the two sides of a contact at t = 0, −δ [m]; negative in overlap. What decimal
/// input leaves of a distance of 0 is 0.
inline double InitialGap(const Scenario& scenario, const Contact& contact) {
  double radii = 0;
  const auto face = [&](int index, double sign) {
    if (index == kNone) return contact.wall_position;
    const Body& body = scenario.bodies[static_cast<std::size_t>(index)];
    radii += body.radius;
    return body.position + sign * body.radius;
  };
  const double left = face(contact.left, 1);
  const double right = face(contact.right, -1);
  const double size = std::max(std::abs(left), std::abs(right)) + radii;
  return std::abs(right - left) <= 1e-12 * size ? 0 : right - left;
}

/// Force of a load at t [s] by its formula [N], whether it acts then or not.
inline double LoadForce(const Load& load, double t) {
  const double since = t - load.begin;
  double force = load.constant + load.slope * since;
  if (load.amplitude != 0) {
    force += load.amplitude * std::sin(load.angular_frequency * since + load.phase);
  }
  return force;
}

/// The smaller sphere of a contact; null if neither side has a radius > 0.
inline const Body* SmallerSphere(const Scenario& scenario, const Contact& contact) {
  const Body* smaller = nullptr;
  for (const int index : {contact.left, contact.right}) {
    if (index == kNone) continue;
    const Body& body = scenario.bodies[static_cast<std::size_t>(index)];
    if (body.radius > 0 && (smaller == nullptr || body.radius < smaller->radius)) smaller = &body;
  }
  return smaller;
}

/// Fastest rate at which one of the loads, or a support, changes its force [1/s]: ω of a sine,
/// √(k/m) or c/m of a support, for which the ground and fixed bodies count 1/m = 0. 0: none does.
inline double ForcingRate(const Scenario& scenario, std::span<const Load> loads) {
  double rate = 0;
  for (const Load& load : loads) {
    if (load.amplitude != 0) rate = std::max(rate, load.angular_frequency);
  }
  const auto inverse_mass = [&](int index) {
    if (index == kNone) return 0.0;
    const Body& body = scenario.bodies[static_cast<std::size_t>(index)];
    return body.fixed ? 0 : 1 / body.mass;
  };
  for (const Support& s : scenario.supports) {
    const double w = inverse_mass(s.body) + inverse_mass(s.other);
    rate = std::max({rate, std::sqrt(s.stiffness * w), s.damping * w});
  }
  return rate;
}

/// Whether a scenario is solved in clusters, with flights in closed form between them. A few bodies
/// are solved together: in a gas of 8 balls clusters are twice as fast, of 20 four times. So are
/// bodies that are pressed at t = 0, for a piece begins with what touches.
inline bool MayPart(const Scenario& scenario) {
  constexpr auto kMany = 8;
  const auto moving = std::ranges::count(scenario.bodies, false, &Body::fixed);
  const auto is_constant = [](const Load& load) {
    return load.begin == 0 && load.end == std::numeric_limits<double>::infinity() &&
           load.slope == 0 && load.amplitude == 0;
  };
  const auto is_apart = [&](const Contact& contact) { return InitialGap(scenario, contact) >= 0; };
  return moving >= kMany && scenario.supports.empty() &&
         std::ranges::all_of(scenario.contacts, is_apart) &&
         std::ranges::all_of(scenario.loads, is_constant) && scenario.solver.fixed_step == 0 &&
         scenario.solver.update == UpdateRule::kNewtonCoupled;
}

}  // namespace contact
