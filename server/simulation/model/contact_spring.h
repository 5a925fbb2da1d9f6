#pragma once

#include <cmath>

#include "simulation/laws/isolated_collision.h"
#include "simulation/laws/power.h"
#include "simulation/model/scenario.h"

namespace contact {

// The elastic force of a contact: k δⁿ, or its table. δ_y is ContactState::yield, and counts for a
// table only.

/// The force [N] at a deformation δ [m] and its slope [N/m], (M2) without damping.
inline Power SpringForce(const Contact& contact, double deformation, double yield) {
  if (!contact.table.empty()) return contact.table.At(deformation, yield);
  Power power(deformation, contact.exponent);
  power.value *= contact.stiffness;
  power.slope *= contact.stiffness;
  return power;
}

/// Elastic energy U of a contact [J], (W2) or (F2); 0 for δ ≤ 0.
inline double ElasticEnergy(const Contact& contact, double deformation, double yield) {
  return contact.table.empty() ? ElasticEnergy(contact.stiffness, contact.exponent, deformation)
                               : contact.table.Energy(deformation, yield);
}

/// The deformation [m] of a contact that rests for the first time under a force [N], ≥ 0.
inline double DepthUnder(const Contact& contact, double force) {
  return contact.table.empty() ? std::pow(force / contact.stiffness, 1 / contact.exponent)
                               : contact.table.DepthUnder(force);
}

/// The largest deformation [m] of an isolated collision with m_e [kg], v > 0 [m/s] and α ≥ 0, (L3)
/// or (F3).
inline double MaximumDeformation(const Contact& contact, double effective_mass, double velocity,
                                 double alpha) {
  if (!contact.table.empty()) {
    return contact.table.DepthOf(0.5 * effective_mass * velocity * velocity, 0);
  }
  return MaximumDeformation(effective_mass, velocity, contact.stiffness, contact.exponent, alpha);
}

}  // namespace contact
