#include "plain_equations.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace contact {
namespace {

std::size_t At(int index) { return static_cast<std::size_t>(index); }

}  // namespace

PlainEquations::State PlainEquations::Start() const {
  State y(2 * scenario_.bodies.size());
  for (std::size_t i = 0; i < scenario_.bodies.size(); ++i) {
    y[scenario_.bodies.size() + i] = scenario_.bodies[i].velocity;
  }
  return y;
}

std::vector<double> PlainEquations::VelocitiesOf(const State& state) const {
  return {state.begin() + static_cast<std::ptrdiff_t>(scenario_.bodies.size()), state.end()};
}

// The distance of the two surfaces at the start [m].
double PlainEquations::Gap(const Contact& contact) const {
  const Body& left = scenario_.bodies[At(contact.left)];
  const double surface = left.position + left.radius;
  if (contact.right == kNone) return contact.wall_position - surface;
  const Body& right = scenario_.bodies[At(contact.right)];
  return right.position - left.position - (left.radius + right.radius);
}

void PlainEquations::operator()(const State& y, State& dy, double t) const {
  const std::size_t n = scenario_.bodies.size();
  std::fill(dy.begin(), dy.end(), 0.0);
  const auto push = [&](int body, double force) {
    dy[n + At(body)] += force / scenario_.bodies[At(body)].mass;
  };
  for (std::size_t i = 0; i < n; ++i) dy[i] = y[n + i];
  for (const Contact& c : scenario_.contacts) {
    const double other = c.right == kNone ? 0 : y[At(c.right)];
    const double deformation = y[At(c.left)] - other - Gap(c);
    if (deformation <= 0) continue;
    const double rate = y[n + At(c.left)] - (c.right == kNone ? 0 : y[n + At(c.right)]);
    const double force = deformation * std::sqrt(deformation) * (c.stiffness + c.mu * rate);
    push(c.left, -force);
    if (c.right != kNone) push(c.right, force);
  }
  for (const Support& s : scenario_.supports) {
    const double stretch = scenario_.bodies[At(s.body)].position + y[At(s.body)] - s.rest_position;
    push(s.body, -s.stiffness * stretch - s.damping * y[n + At(s.body)]);
  }
  for (const Load& load : scenario_.loads) {
    push(load.body,
         load.constant + load.amplitude * std::sin(load.angular_frequency * t + load.phase));
  }
}

}  // namespace contact
