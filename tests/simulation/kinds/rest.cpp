// Bodies that rest, and are disturbed.
#include <cmath>

#include "simulation/kinds/machines.h"

namespace contact::testing {
namespace {

constexpr double kGravity = 9.81;

// The time in which a body falls so far.
double FallTime(double height) { return std::sqrt(2 * height / kGravity); }

// One load more, up to 20 times the weight, on a ball that rests since long before.
void Disturb(Maker& m, int body, double end) {
  const double weight = kGravity * m.At(body).mass, part = m.Log(0.2, 20);
  const double force = weight * part * m.Sign();
  const double begin = m.Uniform(0.2, 0.7) * end, duration = m.Log(0.005, 0.25) * end;
  switch (m.Below(7)) {
    case 0:
      return;  // Gravity only.
    case 1:
      return m.Force(body, -std::abs(force));
    case 2:
      return m.Step(body, force, begin);
    case 3:
      return m.Pulse(body, force, begin, duration);
    case 4:
      return m.HalfSine(body, force, begin, duration);
    case 5:
      return m.Table(body, {{0, 0}, {begin, force}, {begin + duration, force}, {end, 0}});
    default:
      return m.Sine(body, force, m.Log(20, 600));
  }
}

}  // namespace

void Placed(Maker& m) {
  m.stiffness = {1e6, 1e9};
  m.radius = m.Uniform(0.02, 0.05);
  m.Row(1 + m.Below(4));
  m.WallLeft(0);
  m.Neighbours();
  m.s.end_time = m.Log(0.2, 2);
  m.Gravity();
  const int body = m.Below(m.last() + 1);
  const double k = m.Log(1e2, 1e5);
  if (m.Chance(0.12)) m.Spring(body, k, m.Uniform(0, 0.1));
  Disturb(m, body, m.s.end_time);
}

void Stack(Maker& m) {
  m.restitution = {0.15, 0.9};
  m.stiffness = {1e6, 1e9};
  m.Row(1 + m.Below(4));
  const double height = m.Log(0.02, 0.8);
  m.Row(1, height);
  m.WallLeft(0);
  m.Neighbours();
  m.Gravity();
  m.s.end_time = m.Uniform(1.2, 3) * FallTime(height);
}

void Column(Maker& m) {
  m.restitution = {0.1, 0.8};
  const int balls = 2 + m.Below(4);
  for (int i = 0; i < balls; ++i) m.Row(1, m.Log(1e-3, 0.05));
  m.WallLeft(0, m.Log(1e-3, 0.05));
  m.Neighbours();
  m.Gravity();
  m.s.end_time = m.Log(0.3, 2);
}

void Bounce(Maker& m) {
  m.restitution = {0.2, 0.65};
  const double low = m.Log(0.005, 0.1);
  m.Row(1);
  m.WallLeft(0, low);
  // The sum of all flights is (1 + ε)/(1 − ε) times the fall.
  const double e = m.s.contacts[0].restitution;
  const double rest = FallTime(low) * (1 + e) / (1 - e), fall = rest * m.Uniform(1.02, 1.6);
  m.Row(1, kGravity * fall * fall / 2);
  m.Neighbours();
  m.Gravity();
  m.s.end_time = fall + m.Uniform(0.05, 0.5);
}

void Late(Maker& m) {
  m.stiffness = {1e6, 1e9};
  m.exponents = {1.5, 1.5, 1};
  m.Row(m.Chance(0.8) ? 1 : 2);
  m.WallLeft(0);
  m.Neighbours();
  const double force = m.Log(10, 800), part = m.Log(0.02, 3), sign = m.Sign();
  const double begin = m.Log(0.02, 0.2), duration = m.Log(2e-4, 0.01);
  m.Force(m.last(), -force);
  switch (m.Below(3)) {
    case 0:
      m.Step(m.last(), sign * part * force, begin);
      break;
    case 1:
      m.Pulse(m.last(), sign * part * force, begin, duration);
      break;
    default:
      m.HalfSine(m.last(), sign * part * force, begin, duration);
  }
  m.s.end_time = begin + m.Log(0.01, 0.3);
}

void Valve(Maker& m) {
  m.mass = {0.01, 0.2};
  m.stiffness = {1e7, 1e9};
  m.restitution = {0.2, 0.7};
  m.radius = 0;
  m.Row(1);
  m.WallLeft(0);
  const double k = m.Log(5e3, 5e4), preload = m.Log(1e-3, 0.02), ratio = m.Uniform(0.01, 0.2);
  m.Spring(0, k, ratio).rest_position = -preload;
  double begin = m.Uniform(0.005, 0.03);
  for (int pulses = 1 + m.Below(3); pulses > 0; --pulses) {
    const double force = k * preload * m.Uniform(1.2, 4), duration = m.Log(0.003, 0.03);
    m.Pulse(0, force, begin, duration);
    begin += duration + m.Log(0.005, 0.05);
  }
  m.s.end_time = begin;
}

void Press(Maker& m) {
  m.mass = {0.005, 0.5};
  m.exponents = {1, 1.5};
  m.radius = 0;
  m.Row(1);
  m.WallRight(0, m.Chance(0.7) ? 0 : m.Log(1e-5, 1e-3));
  double time = m.Chance(0.5) ? 0 : m.Uniform(0.001, 0.05);
  std::vector<Maker::Point> points = {{time, 0}};
  for (int presses = 1 + m.Below(2); presses > 0; --presses) {
    const double force = m.Log(5, 500);
    const double hold = m.Chance(0.2) ? 0.5 * force : force;  // Some give way before they let go.
    points.push_back({time += m.Log(0.005, 0.1), force});
    points.push_back({time += m.Log(0.01, 0.1), hold});
    points.push_back({time += m.Log(0.005, 0.1), 0});
  }
  m.Table(0, points);
  m.s.end_time = time + m.Log(0.01, 0.1);
}

}  // namespace contact::testing
