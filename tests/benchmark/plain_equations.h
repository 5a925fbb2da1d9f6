#pragma once

#include <cstddef>
#include <vector>

#include "simulation/model/scenario.h"

namespace contact {

/// The equations of motion (M1) to (M4) of contacts with a given μ and exponent 1.5, without
/// events: the force of a contact is 0 where δ ≤ 0. The state is displacements from the start [m],
/// then velocities [m/s].
class PlainEquations {
 public:
  using State = std::vector<double>;

  /// Its contacts are of two bodies, or have a wall to their right; supports lead to the ground,
  /// and loads act from the start to the end.
  explicit PlainEquations(const Scenario& scenario);

  State Start() const;
  std::vector<double> VelocitiesOf(const State& state) const;
  void operator()(const State& y, State& dy, double t) const;

 private:
  const Scenario& scenario_;
  std::size_t bodies_;
  std::vector<double> inverse_masses_, gaps_;  // [1/kg] of bodies, [m] of contacts.
};

}  // namespace contact
