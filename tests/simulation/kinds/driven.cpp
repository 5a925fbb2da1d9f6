// Bodies on springs, tables and pistons.
#include <algorithm>
#include <cmath>

#include "simulation/kinds/machines.h"

namespace contact::testing {
namespace {

// The second body of the scenario is the ball; the two others are the stops of one frame.
void Frame(Maker& m, double clearance, double joint) {
  m.radius = 0;
  m.Ball(-clearance / 2);
  m.mass = {0.05 * m.At(0).mass, 0.3 * m.At(0).mass};
  m.Ball(m.Uniform(-0.4, 0.4) * clearance);
  m.mass = {m.At(0).mass, m.At(0).mass};
  m.Ball(clearance / 2);
  m.Joint(2, 0, joint, m.Chance(0.5) ? 0 : m.Log(1e-4, 0.1));
  m.Neighbours();
}

}  // namespace

void Damper(Maker& m) {
  m.mass = {0.3, 3};
  m.stiffness = {1e6, 1e8};
  const double joint = m.Log(1e6, 1e9), clearance = m.Log(1e-3, 0.02);
  Frame(m, clearance, joint);
  const double omega = m.Uniform(25, 40), natural = m.Uniform(25, 40);
  const double mass = m.At(0).mass + m.At(2).mass;
  m.Spring(0, mass * natural * natural, m.Log(0.005, 0.05));
  m.Sine(0, m.Log(3, 30), omega);
  m.s.end_time = m.Log(0.2, 1.5);
}

void Joined(Maker& m) {
  m.radius = 0.01;
  const double k = m.Log(1e5, 1e9), ratio = m.Chance(0.4) ? 0 : m.Log(1e-4, 0.3);
  const int way = m.Below(3);
  m.Row(2 + m.Below(2), 0.02);
  for (int i = 0; i < m.last(); ++i) m.Joint(i + 1, i, k, ratio);
  if (way == 0) {  // Falls on a floor.
    m.WallLeft(0, m.Log(1e-3, 0.05));
    m.Gravity();
  } else {  // A ball strikes it, or pushes.
    const int ball = m.Ball(m.At(0).position - 0.02 - (way == 1 ? m.Log(1e-5, 1e-3) : 0));
    m.Pair(ball, 0);
    if (way == 1) m.Last().velocity = m.Log(0.05, 2);
    if (way == 2) m.Force(ball, m.Log(1, 100));
  }
  m.s.end_time = m.Log(0.02, 0.3);
}

void Shaken(Maker& m) {
  const double omega = m.Log(40, 600), acceleration = m.Uniform(0.3, 6) * 9.81;
  m.mass = {0.02, 0.5};
  m.radius = 0.01;
  m.Row(1);
  m.At(0).mass = m.OneOf({10, 100, 1e4});
  m.Row(1, m.Chance(0.3) ? 0 : m.Log(1e-5, 1e-2));
  m.Pair(0, 1);
  if (m.Chance(0.5)) {  // Heavy, and free: x = −a/ω² sin(ω t) about its place.
    m.At(0).velocity = -acceleration / omega;
    m.Sine(0, m.At(0).mass * acceleration, omega);
  } else {  // On a spring, far below its resonance.
    m.Spring(0, m.At(0).mass * 100 * omega * omega, 0.1);
    m.Sine(0, m.At(0).mass * 99 * acceleration, omega);
  }
  m.Force(1, -9.81 * m.At(1).mass);
  m.s.end_time = m.Uniform(3, 12) * 6.283 / omega;
}

void Piston(Maker& m) {
  m.Row(1);
  m.At(0).mass = m.Log(0.3, 5);
  const double omega = m.Log(20, 500), gap = m.Log(1e-5, 2e-3);
  const double stroke = m.Uniform(1.2, 8) * gap, k = m.At(0).mass * omega * omega * 4;
  m.Row(1 + m.Below(3), m.Chance(0.5) ? 0 : gap / 3);
  m.Neighbours();
  m.WallRight(m.last(), gap);
  m.Spring(0, k, m.Uniform(0.02, 0.3));
  m.Sine(0, 0.75 * k * stroke, omega, m.Chance(0.5) ? 0 : 1.5708);  // 1/(1 − ¼) of k_e at 2 ω.
  m.s.end_time = m.Uniform(2, 8) * 6.283 / omega;
}

void Pulses(Maker& m) {
  m.Row(1 + m.Below(4));
  m.Neighbours();
  if (m.last() == 0 || m.Chance(0.6)) m.WallRight(m.last(), m.Chance(0.5) ? 0 : m.Log(1e-6, 1e-3));
  m.s.end_time = m.Log(3e-3, 0.05);
  for (int loads = 1 + m.Below(3); loads > 0; --loads) {
    const int body = m.Below(m.last() + 1);
    const double begin = m.Chance(0.3) ? 0 : m.Uniform(0, 0.6) * m.s.end_time;
    const double duration = m.Log(0.02, 0.6) * m.s.end_time, force = m.Log(5, 500);
    const double right = m.Chance(0.7) ? force : -force;
    const int form = m.Below(3);
    if (form == 0) m.Pulse(body, right, begin, duration);
    if (form == 1) m.HalfSine(body, right, begin, duration);
    if (form == 2) {
      std::vector<Maker::Point> points;
      const int last = 2 + m.Below(5);
      for (int i = 0; i <= last; ++i) {
        points.push_back({begin + duration * i / last, right * m.Uniform(-0.3, 1)});
      }
      m.Table(body, points);
    }
  }
}

}  // namespace contact::testing
