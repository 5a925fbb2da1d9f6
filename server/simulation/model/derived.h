#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "simulation/laws/spring.h"
#include "simulation/model/scenario.h"

namespace contact {

// What follows from a scenario at once.

/// The distance of the two sides of a contact at t = 0, −δ [m]; negative in overlap. What decimal
/// input leaves of a distance of 0 is 0.
inline double InitialGap(const Scenario& scenario, const Contact& contact) {
  double size = contact.play;
  const auto face = [&](int index, double sign) {
    if (index == kNone) return contact.wall_position;
    const Body& body = scenario.bodies[static_cast<std::size_t>(index)];
    const double radius = contact.play > 0 ? 0 : body.radius;
    size += radius;
    return body.position + sign * radius;
  };
  const double left = face(contact.left, 1);
  const double right = face(contact.right, -1);
  size += std::max(std::abs(left), std::abs(right));
  const double gap = right - left + contact.play;
  return std::abs(gap) <= 1e-12 * size ? 0 : gap;
}

/// How many numbers a sample of the trajectory has, as Samples lists them.
inline int SampleColumns(const Scenario& scenario) {
  constexpr std::size_t kTime = 1, kOfSystem = 5;
  return static_cast<int>(kTime + 3 * scenario.bodies.size() + 4 * scenario.contacts.size() +
                          2 * scenario.supports.size() + kOfSystem);
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

/// Where a driven body is at t [s] by a piece of its motion, whether it lasts then or not.
struct DrivenMotion {
  double position, velocity, acceleration;  ///< [m], [m/s], [m/s²].
};
inline DrivenMotion MotionAt(const Drive& drive, double t) {
  const double since = t - drive.begin;
  DrivenMotion at;
  at.acceleration = drive.acceleration + drive.jerk * since;
  at.velocity = drive.velocity + (drive.acceleration + drive.jerk * since / 2) * since;
  at.position =
      drive.position +
      (drive.velocity + (drive.acceleration / 2 + drive.jerk * since / 6) * since) * since;
  if (drive.amplitude == 0) return at;
  const double w = drive.angular_frequency;
  const double sine = drive.amplitude * std::sin(w * since + drive.phase);
  at.position += sine;
  at.velocity += drive.amplitude * w * std::cos(w * since + drive.phase);
  at.acceleration -= w * w * sine;
  return at;
}

/// How far a piece of a motion leads from one instant to another [m], to all digits however little
/// that is beside the position.
inline double Displacement(const Drive& drive, double from, double to) {
  const double since = from - drive.begin, h = to - from;
  const double acceleration = drive.acceleration + drive.jerk * since;
  const double velocity = drive.velocity + (drive.acceleration + drive.jerk * since / 2) * since;
  const double moved = (velocity + (acceleration / 2 + drive.jerk * h / 6) * h) * h;
  if (drive.amplitude == 0) return moved;
  const double half = drive.angular_frequency * h / 2;
  const double middle = drive.angular_frequency * since + half + drive.phase;
  return moved + 2 * drive.amplitude * std::cos(middle) * std::sin(half);
}

/// The smaller sphere of a contact; null if neither side has a radius > 0, or radii do not count.
inline const Body* SmallerSphere(const Scenario& scenario, const Contact& contact) {
  const Body* smaller = nullptr;
  if (contact.play > 0) return smaller;
  for (const int index : {contact.left, contact.right}) {
    if (index == kNone) continue;
    const Body& body = scenario.bodies[static_cast<std::size_t>(index)];
    if (body.radius > 0 && (smaller == nullptr || body.radius < smaller->radius)) smaller = &body;
  }
  return smaller;
}

/// By how much a support is longer at t = 0 than without force [m].
inline double InitialStretch(const Scenario& scenario, const Support& support) {
  const auto place = [&](int body) {
    return body == kNone ? 0 : scenario.bodies[static_cast<std::size_t>(body)].position;
  };
  return place(support.body) - place(support.other) - support.rest_position;
}

/// The stiffness of a support as rates want it [N/m]: the larger of those without force and at the
/// start.
inline double StiffnessOf(const Scenario& scenario, const Support& support) {
  if (support.higher.empty()) return support.stiffness;
  const Spring spring(support.stiffness, support.higher, InitialStretch(scenario, support));
  return std::max(support.stiffness, std::abs(spring.slope));
}

/// Fastest rate at which one of the loads or drives, or a support, changes its force [1/s]: ω of a
/// sine, √(k/m) or c/m of a support, for which the ground and fixed bodies count 1/m = 0. 0: none
/// does.
inline double ForcingRate(const Scenario& scenario, std::span<const Load> loads,
                          std::span<const Drive> drives = {}) {
  double rate = 0;
  const auto see = [&](const auto& pieces) {
    for (const auto& piece : pieces) {
      if (piece.amplitude != 0) rate = std::max(rate, piece.angular_frequency);
    }
  };
  see(loads);
  see(drives);
  const auto inverse_mass = [&](int index) {
    if (index == kNone) return 0.0;
    const Body& body = scenario.bodies[static_cast<std::size_t>(index)];
    return body.fixed ? 0 : 1 / body.mass;
  };
  for (const Support& s : scenario.supports) {
    const double w = inverse_mass(s.body) + inverse_mass(s.other);
    rate = std::max({rate, std::sqrt(StiffnessOf(scenario, s) * w), s.damping * w});
  }
  return rate;
}

/// Whether a load is the same all the time.
inline bool IsSteady(const Load& load) {
  return load.begin == 0 && std::isinf(load.end) && load.slope == 0 && load.amplitude == 0;
}

/// Whether most bodies are pressed against each other at t = 0, or touch where something shakes
/// them or holds them back: elsewhere a pulse leaves them.
inline bool IsHeldTogether(const Scenario& scenario) {
  const bool stays = !scenario.supports.empty() || !scenario.drives.empty() ||
                     !std::ranges::all_of(scenario.loads, IsSteady);
  const auto closed = std::ranges::count_if(scenario.contacts, [&](const Contact& contact) {
    const double gap = InitialGap(scenario, contact);
    return gap < 0 || (gap == 0 && stays);
  });
  return 2 * closed > std::ssize(scenario.bodies);
}

/// Whether a scenario is solved in clusters, with flights between them. A few bodies are solved
/// together: in a gas of 8 balls clusters are twice as fast, of 20 four times. So are bodies that
/// are held together: of 30 cradles and 30 columns clusters take 4 times the steps. So is what a
/// spring holds that slips, for only its whole motion tells how far.
inline bool MayPart(const Scenario& scenario) {
  constexpr auto kMany = 8;
  const auto moving = std::ranges::count(scenario.bodies, false, &Body::fixed);
  const auto slips = [](const Support& support) { return !std::isinf(support.slip_force); };
  return moving >= kMany && scenario.solver.fixed_step == 0 &&
         scenario.solver.update == UpdateRule::kNewtonCoupled &&
         std::ranges::none_of(scenario.supports, slips) && !IsHeldTogether(scenario);
}

}  // namespace contact
