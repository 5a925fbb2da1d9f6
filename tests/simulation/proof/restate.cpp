#include "simulation/proof/restate.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>

#include "simulation/model/derived.h"

namespace contact::testing {
namespace {

Restated Same(std::string_view how, const Scenario& s) {
  Restated r{.how = how, .scenario = s, .bodies = {}, .contacts = {}};
  r.bodies.resize(s.bodies.size());
  r.contacts.resize(s.contacts.size());
  std::iota(r.bodies.begin(), r.bodies.end(), 0);
  std::iota(r.contacts.begin(), r.contacts.end(), 0);
  return r;
}

Restated Mirrored(const Scenario& s) {
  Restated r = Same("mirrored", s);
  r.direction = -1;
  for (Body& b : r.scenario.bodies) b.position = -b.position, b.velocity = -b.velocity;
  for (Contact& c : r.scenario.contacts) {
    std::swap(c.left, c.right);
    c.wall_position = -c.wall_position;
  }
  for (Support& p : r.scenario.supports) p.rest_position = -p.rest_position;
  for (Load& l : r.scenario.loads) {
    l.constant = -l.constant, l.slope = -l.slope, l.amplitude = -l.amplitude;
  }
  for (Drive& d : r.scenario.drives) {
    d.position = -d.position, d.velocity = -d.velocity, d.acceleration = -d.acceleration;
    d.jerk = -d.jerk, d.amplitude = -d.amplitude;
  }
  return r;
}

// By about the size of the whole, and a number of few bits.
Restated Shifted(const Scenario& s) {
  Restated r = Same("shifted", s);
  double size = 0;
  for (const Body& b : s.bodies) size = std::max(size, std::abs(b.position) + b.radius);
  const double shift = size > 0 ? std::exp2(std::floor(std::log2(size))) : 0.5;
  for (Body& b : r.scenario.bodies) b.position += shift;
  for (Drive& d : r.scenario.drives) d.position += shift;
  for (Contact& c : r.scenario.contacts) {
    if (c.left == kNone || c.right == kNone) c.wall_position += shift;
  }
  for (Support& p : r.scenario.supports) {
    if (p.other == kNone) p.rest_position += shift;
  }
  return r;
}

std::optional<Restated> Drifting(const Scenario& s) {
  const bool grounded =
      std::ranges::any_of(s.bodies, &Body::fixed) ||
      std::ranges::any_of(s.supports, [](const Support& p) { return p.other == kNone; }) ||
      std::ranges::any_of(s.contacts,
                          [](const Contact& c) { return c.left == kNone || c.right == kNone; });
  if (grounded) return {};
  Restated r = Same("from a moving frame", s);
  r.drift = 0.5;
  for (Body& b : r.scenario.bodies) b.velocity += r.drift;
  return r;
}

// Powers of two, whose products are exact also with the exponents 1.25, 1.5, 2.5 and 3.5.
Restated InUnits(const Scenario& s) {
  Restated r = Same("in other units", s);
  r.mass = 0x1p-5, r.length = 0x1p4, r.time = 0x1p-3;
  const double force = r.Force(1), speed = r.length / r.time;
  for (Body& b : r.scenario.bodies) {
    b.mass /= r.mass, b.radius /= r.length, b.position /= r.length, b.velocity /= speed;
  }
  for (Contact& c : r.scenario.contacts) {
    c.mu /= r.Mu(1, DampingExponent(c.damping, c.exponent));
    c.wall_position /= r.length, c.play /= r.length, c.reference_velocity /= speed;
    c.stiffness /= force / std::pow(r.length, c.exponent);
  }
  for (Support& p : r.scenario.supports) {
    p.stiffness /= force / r.length, p.damping /= force / speed, p.rest_position /= r.length;
  }
  for (Load& l : r.scenario.loads) {
    l.begin /= r.time, l.end /= r.time, l.constant /= force, l.slope /= force / r.time;
    l.amplitude /= force, l.angular_frequency *= r.time;
  }
  for (Drive& d : r.scenario.drives) {
    d.begin /= r.time, d.end /= r.time, d.angular_frequency *= r.time;
    d.position /= r.length, d.velocity /= speed, d.amplitude /= r.length;
    d.acceleration /= speed / r.time, d.jerk /= speed / r.time / r.time;
  }
  r.scenario.end_time /= r.time;
  return r;
}

Restated Reordered(const Scenario& s) {
  Restated r = Same("in another order", s);
  const auto turned = [](int i, std::size_t n) {
    return (2 * static_cast<int>(n) - 2 - i) % static_cast<int>(n);
  };
  for (int& i : r.bodies) i = turned(i, s.bodies.size());
  for (int& i : r.contacts) i = turned(i, s.contacts.size());
  const auto there = [&](int& body) {
    if (body != kNone) body = r.bodies[static_cast<std::size_t>(body)];
  };
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    Body& b = r.scenario.bodies[static_cast<std::size_t>(r.bodies[i])];
    b = s.bodies[i], b.name = "other" + std::to_string(i);
  }
  for (std::size_t i = 0; i < s.contacts.size(); ++i) {
    Contact& c = r.scenario.contacts[static_cast<std::size_t>(r.contacts[i])];
    c = s.contacts[i], c.name = "touch" + std::to_string(7 * i);
    there(c.left), there(c.right);
  }
  for (Support& p : r.scenario.supports) there(p.body), there(p.other);
  for (Load& l : r.scenario.loads) there(l.body);
  for (Drive& d : r.scenario.drives) there(d.body);
  std::ranges::reverse(r.scenario.supports);
  std::ranges::reverse(r.scenario.loads);
  return r;
}

std::optional<Restated> InHalves(const Scenario& s) {
  if (s.loads.empty()) return {};
  Restated r = Same("with loads in halves", s);
  for (Load& l : r.scenario.loads) l.constant /= 2, l.slope /= 2, l.amplitude /= 2;
  const std::vector<Load> halves = r.scenario.loads;
  r.scenario.loads.insert(r.scenario.loads.end(), halves.begin(), halves.end());
  return r;
}

bool IsConstant(const Load& l) {
  return l.begin == 0 && std::isinf(l.end) && l.slope == 0 && l.amplitude == 0;
}

// All bodies as they were a time before, had they flown; constant loads acted then, others not.
void FlyBack(Scenario& s, double time) {
  std::vector<double> acceleration(s.bodies.size());
  for (const Load& l : s.loads) {
    const auto body = static_cast<std::size_t>(l.body);
    if (IsConstant(l)) acceleration[body] += l.constant / s.bodies[body].mass;
  }
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    Body& b = s.bodies[i];
    if (b.fixed) continue;
    b.position += time * (acceleration[i] * time / 2 - b.velocity);
    b.velocity -= acceleration[i] * time;
  }
}

// A touch that comes so soon after is one at the start: what is left of its gap is round-off.
bool IsFree(const Scenario& s) {
  const auto speed = [&](int body) {
    return body == kNone ? 0 : s.bodies[static_cast<std::size_t>(body)].velocity;
  };
  return std::ranges::all_of(s.contacts, [&](const Contact& c) {
    const double gap = InitialGap(s, c);
    return gap > 0 || (gap == 0 && speed(c.left) == speed(c.right));
  });
}

// Where nothing else than a flight leads to the start.
std::optional<Restated> Earlier(const Scenario& s) {
  if (!s.supports.empty() || !s.drives.empty() || s.starts_at_rest) return {};
  for (double delay = s.end_time / 8; delay > s.end_time / 1000; delay /= 4) {
    bool free = true;
    for (int part = 1; part <= 8; ++part) {
      Scenario before = s;
      FlyBack(before, delay * part / 8);
      free = free && IsFree(before);
    }
    if (!free) continue;
    Restated r = Same("begun earlier", s);
    r.delay = delay;
    FlyBack(r.scenario, delay);
    for (Load& l : r.scenario.loads) {
      if (!IsConstant(l)) l.begin += delay, l.end += delay;
    }
    r.scenario.end_time += delay;
    return r;
  }
  return {};
}

Restated Finer(const Scenario& s) {
  Restated r = Same("with tolerance 1e-12", s);
  r.scenario.solver.relative_tolerance = 1e-12;
  return r;
}

Restated Longer(const Scenario& s) {
  Restated r = Same("to an end 31 % later", s);
  r.scenario.end_time *= 1.31;
  r.longer = true;
  return r;
}

}  // namespace

double Restated::Mu(double mu, double p) const { return mu * mass / time / std::pow(length, p); }

std::vector<Restated> Restate(const Scenario& s) {
  std::vector<Restated> all = {Mirrored(s),  Shifted(s), InUnits(s),
                               Reordered(s), Finer(s),   Longer(s)};
  for (std::optional<Restated> other : {Drifting(s), InHalves(s), Earlier(s)}) {
    if (other) all.push_back(*std::move(other));
  }
  return all;
}

}  // namespace contact::testing
