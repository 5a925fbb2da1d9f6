// Blows of extreme restitution, exponent, mass and size.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/kinds/machines.h"

namespace contact::testing {
namespace {

// A row of touching or nearly touching balls that the first one strikes, perhaps before a wall.
void Struck(Maker& m, int balls) {
  m.Row(1);
  m.At(0).velocity = m.Uniform(0.05, 2);
  for (int i = 1; i < balls; ++i) m.Row(1, m.Chance(0.5) ? 0 : m.Log(1e-6, 1e-3));
  if (m.Chance(0.3)) m.Last().velocity = m.Uniform(-1, 0);
  m.Neighbours();
  if (m.Chance(0.4)) m.WallRight(m.last(), m.Chance(0.5) ? 0 : m.Log(1e-6, 1e-3));
}

// How long a blow between such bodies lasts that deforms them by so much at the speed: Hertz's.
double BlowTime(double deformation, double velocity) { return 3 * deformation / velocity; }

// Six blows of the softest contact, one after the other for each ball.
void EndAfterBlows(Maker& m) {
  double longest = 0;
  const double v = std::max(m.At(0).velocity, 0.01);
  for (const Contact& c : m.s.contacts) {
    const double left = c.left == kNone ? 0 : 1 / m.At(c.left).mass;
    const double right = c.right == kNone ? 0 : 1 / m.At(c.right).mass;
    longest =
        std::max(longest, MaximumDeformation(1 / (left + right), v, c.stiffness, c.exponent, 0));
  }
  const double balls = m.last() + 1;
  m.s.end_time = std::min(0.1, BlowTime(longest, v) * (2 + balls) + 2e-4);
}

}  // namespace

void Plastic(Maker& m) {
  m.mass = {0.1, 3};
  m.stiffness = {1e5, 1e8};
  m.radius = 0;
  m.Row(1);
  m.WallLeft(0, m.Chance(0.2) ? 0 : m.Uniform(0.01, 1)).restitution = m.Log(0.002, 0.1);
  if (m.s.contacts[0].wall_position < 0) m.At(0).velocity = m.Uniform(-2, 1);
  m.Gravity();
  m.s.end_time = m.Log(1, 20);
}

void Elastic(Maker& m) {
  Struck(m, 2 + m.Below(4));
  for (Contact& c : m.s.contacts) {
    const int which = m.Below(5);
    if (which < 2) c.restitution = 1;
    if (which > 2) c.restitution = m.Log(0.01, 0.1);
  }
  EndAfterBlows(m);
}

void Exponents(Maker& m) {
  Struck(m, 2 + m.Below(5));
  for (Contact& c : m.s.contacts) {
    // As stiff as a ball of 0.5 kg with 1 m/s needs to be deformed so much.
    const double deformation = m.Log(3e-6, 3e-4);
    c.exponent = m.OneOf({1, 1.25, 1.5, 2, 2.5, 3, 3.5, 4});
    c.stiffness = 0.5 * (c.exponent + 1) / 2 / std::pow(deformation, c.exponent + 1);
  }
  EndAfterBlows(m);
}

// Up to MU: with one more every seed would roll another scenario.
constexpr int kRolledLaws = static_cast<int>(DampingLaw::kGiven);

void Laws(Maker& m) {
  Struck(m, 2 + m.Below(4));
  for (std::size_t i = 0; i < m.s.contacts.size(); ++i) {
    Contact& c = m.s.contacts[i];
    const DampingLawRow& law = DampingLaws()[static_cast<std::size_t>(m.Below(kRolledLaws))];
    if (i == 0 || m.Chance(0.4)) continue;  // ENERGY_RESTITUTION.
    c.damping = law.law;
    if (law.contact_exponent != 0) c.exponent = law.contact_exponent;
    if (law.law == DampingLaw::kGiven) c.mu = c.stiffness * m.Log(0.01, 3);
    if (law.scale == DampingScale::kVelocity && m.Chance(0.5))
      c.reference_velocity = m.Log(0.05, 2);
  }
  EndAfterBlows(m);
}

void Ratios(Maker& m) {
  m.mass = {1e-3, 1e3};
  m.stiffness = {1e4, 1e10};
  Struck(m, 2 + m.Below(4));
  EndAfterBlows(m);
}

void Sizes(Maker& m) {
  m.radius = m.Log(1e-6, 100);
  const double density = m.Log(1e3, 1e4), hertz = 4.0 / 3 * std::sqrt(m.radius);
  const double mass = 4.0 / 3 * std::numbers::pi * density * std::pow(m.radius, 3);
  m.mass = {mass, 3 * mass};
  m.stiffness = {hertz * 1e7, hertz * 2e11};
  const double gap = m.radius * m.Log(1e-6, 1e-2);
  m.Row(1);
  m.At(0).velocity = m.Log(1e-3, 5);
  m.Row(1 + m.Below(3));
  m.Neighbours();
  if (m.Chance(0.5)) m.WallRight(m.last(), gap);
  const double v = m.At(0).velocity;
  const double deformation = MaximumDeformation(mass, v, m.s.contacts[0].stiffness, 1.5, 0);
  m.s.end_time = m.Uniform(2, 8) * BlowTime(deformation, v) + 2 * gap / v;
}

void Clipped(Maker& m) {
  m.restitution = {0.05, 0.6};
  m.s.solver.clip_tension = true;
  Struck(m, 1 + m.Below(4));
  if (m.s.contacts.empty()) m.WallRight(0, m.Log(1e-6, 1e-3));
  EndAfterBlows(m);
  // Pulls at the first ball while it leaves.
  const double force = m.Log(10, 1e4), begin = m.Uniform(0.05, 0.5) * m.s.end_time;
  if (m.Chance(0.7)) m.Step(0, -force, begin);
}

}  // namespace contact::testing
