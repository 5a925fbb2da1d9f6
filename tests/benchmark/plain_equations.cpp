#include "plain_equations.h"

#include <algorithm>
#include <cmath>

#include "simulation/model/derived.h"
#include "simulation/model/index.h"

namespace contact {

PlainEquations::PlainEquations(const Scenario& scenario)
    : scenario_(scenario), bodies_(scenario.bodies.size()) {
  for (const Body& body : scenario.bodies) inverse_masses_.push_back(1 / body.mass);
  for (const Contact& contact : scenario.contacts) gaps_.push_back(InitialGap(scenario, contact));
}

PlainEquations::State PlainEquations::Start() const {
  State y(2 * bodies_);
  for (std::size_t i = 0; i < bodies_; ++i) y[bodies_ + i] = scenario_.bodies[i].velocity;
  return y;
}

std::vector<double> PlainEquations::VelocitiesOf(const State& state) const {
  return {state.begin() + static_cast<std::ptrdiff_t>(bodies_), state.end()};
}

void PlainEquations::operator()(const State& y, State& dy, double t) const {
  const double* v = y.data() + bodies_;
  double* a = dy.data() + bodies_;
  std::copy(v, v + bodies_, dy.begin());
  std::fill(a, a + bodies_, 0.0);
  for (std::size_t i = 0; i < gaps_.size(); ++i) {
    const Contact& c = scenario_.contacts[i];
    const std::size_t left = At(c.left), right = At(c.right);
    const bool wall = c.right == kNone;
    const double deformation = y[left] - (wall ? 0 : y[right]) - gaps_[i];
    if (deformation <= 0) continue;
    const double rate = v[left] - (wall ? 0 : v[right]);
    const double force = deformation * std::sqrt(deformation) * (c.stiffness + c.mu * rate);
    a[left] -= force * inverse_masses_[left];
    if (!wall) a[right] += force * inverse_masses_[right];
  }
  for (const Support& s : scenario_.supports) {
    const std::size_t body = At(s.body);
    const double stretch = scenario_.bodies[body].position + y[body] - s.rest_position;
    a[body] -= (s.stiffness * stretch + s.damping * v[body]) * inverse_masses_[body];
  }
  for (const Load& load : scenario_.loads) {
    const double sine = std::sin(load.angular_frequency * t + load.phase);
    a[At(load.body)] += (load.constant + load.amplitude * sine) * inverse_masses_[At(load.body)];
  }
}

}  // namespace contact
