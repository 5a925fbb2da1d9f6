#pragma once

#include <vector>

#include "simulation/model/scenario.h"

namespace contact {

/// The equations of motion (M1) to (M4) of contacts with a given μ and exponent 1.5, without
/// events: the force of a contact is 0 where δ ≤ 0. The state is displacements from the start [m],
/// then velocities [m/s].
class PlainEquations {
 public:
  using State = std::vector<double>;

  explicit PlainEquations(const Scenario& scenario) : scenario_(scenario) {}

  State Start() const;
  std::vector<double> VelocitiesOf(const State& state) const;
  void operator()(const State& y, State& dy, double t) const;

 private:
  double Gap(const Contact& contact) const;

  const Scenario& scenario_;
};

}  // namespace contact
