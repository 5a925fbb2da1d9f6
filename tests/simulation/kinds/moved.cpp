// What moves as given, has play on two sides, or is pressed when the run begins.
#include "simulation/kinds/machines.h"
#include "simulation/statics/equilibrium.h"

namespace contact::testing {

void Table(Maker& m) {
  const double omega = m.Log(40, 600), gamma = m.Uniform(0.3, 6);
  m.mass = {0.02, 0.5};
  m.radius = 0.01;
  m.Row(1);
  m.Swing(0, gamma * 9.81 / (omega * omega), omega);
  m.Row(1 + m.Below(2), m.Chance(0.3) ? 0 : m.Log(1e-5, 1e-2));
  m.Neighbours();
  m.Gravity();
  m.s.end_time = m.Uniform(3, 12) * 6.283 / omega;
}

void Rattle(Maker& m) {
  m.radius = 0;
  m.mass = {0.02, 0.5};
  m.stiffness = {1e6, 1e8};
  const double play = m.Log(1e-4, 5e-3), omega = m.Log(30, 300);
  const int way = m.Below(3);
  m.Ball(0);
  if (way == 0) m.Swing(0, m.Log(0.3, 10) * play, omega);  // A slot that is shaken,
  if (way == 1) {                                          // that swings on a spring,
    m.At(0).mass = m.Log(0.1, 5);
    m.Spring(0, m.At(0).mass * m.Log(0.5, 2) * omega * omega, 0.05);
    m.Sine(0, m.Log(0.3, 10) * play * m.At(0).mass * omega * omega, omega);
  }
  m.Ball(m.Uniform(-0.9, 0.9) * play, m.Uniform(-2, 2) * play * omega);
  way == 2 ? m.Play(1, kNone, play, 0) : m.Play(1, 0, play);  // or that stands.
  m.s.end_time = m.Uniform(2, 10) * 6.283 / omega;
}

void Moved(Maker& m) {
  m.Row(1);
  const double gap = m.Log(1e-4, 5e-3), time = m.Log(3e-3, 0.05);
  m.Row(1 + m.Below(4), m.Chance(0.5) ? 0 : m.Log(1e-5, 1e-3));
  for (int i = 1; i <= m.last(); ++i) m.At(i).position += gap;
  m.Neighbours();
  m.WallRight(m.last(), m.Log(1e-3, 0.05));
  const double rise = 2 * gap / (time * time) * m.Log(0.5, 20);
  m.Move(0, {{rise, time}, {m.OneOf({0, -rise / 2}), time}, {-rise, m.Uniform(0.2, 1) * time}});
  m.s.end_time = 4 * time;
}

void Clamped(Maker& m) {
  m.Row(2 + m.Below(4));
  m.Neighbours();
  m.WallLeft(0);
  m.WallRight(m.last());
  // Pressed together by a stop that stands further in than the balls reach.
  m.s.contacts.back().wall_position -= m.Log(1e-7, 1e-5) * m.last();
  if (m.Chance(0.5)) m.Gravity();
  m.s.end_time = m.Log(3e-3, 0.05);
  const Equilibrium held = FindEquilibrium(m.s);
  for (int i = 0; i <= m.last(); ++i) {
    m.At(i).position = held.positions[static_cast<std::size_t>(i)];
  }
  m.s.starts_at_rest = true;
  const int body = m.Below(m.last() + 1);
  const double begin = m.Uniform(0.05, 0.3) * m.s.end_time, force = m.Sign() * m.Log(1, 300);
  if (m.Chance(0.5)) {
    m.HalfSine(body, force, begin, m.Log(0.02, 0.3) * m.s.end_time);
  } else {
    m.Step(body, force, begin);
  }
}

}  // namespace contact::testing
