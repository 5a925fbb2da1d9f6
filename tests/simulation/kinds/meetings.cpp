// Who meets whom, and when.
#include <algorithm>
#include <cmath>

#include "simulation/kinds/machines.h"

namespace contact::testing {
namespace {

// All bodies with one mass, all contacts with one law, as a symmetric machine has them.
void Alike(Maker& m) {
  for (Body& b : m.s.bodies) b.mass = m.At(0).mass;
  for (Contact& c : m.s.contacts) {
    c.stiffness = m.s.contacts[0].stiffness;
    c.restitution = m.s.contacts[0].restitution;
  }
}

// Two touches at one instant, in one of five ways.
struct Tie {
  int second;   // The ball of one of the touches that may be shifted.
  double away;  // The sign of a shift that makes this touch later.
  double gap;   // How wide both gaps are.
};

Tie TwoOnOneFloor(Maker& m, double gap) {
  m.Ball(0);
  m.Ball(0);
  m.WallLeft(0, gap);
  m.WallLeft(1, gap);
  Alike(m);
  m.Gravity();
  m.s.end_time = std::sqrt(2 * gap / 9.81) * m.Uniform(1.5, 4);
  return {1, 1, gap};
}

// Both ends strike a row in the middle, of one ball or more.
Tie BothEnds(Maker& m, double gap, double velocity) {
  m.Ball(0, velocity);
  const int middle = 1 + m.Below(3);
  m.Row(1, gap);
  m.Row(middle - 1);
  m.Row(1, gap);
  m.Last().velocity = -velocity;
  m.Neighbours();
  if (m.Chance(0.7)) Alike(m);
  m.s.end_time = gap / velocity + m.Uniform(0.002, 0.01);
  return {m.last(), 1, gap};
}

// A row of which each gap is as wide, between walls.
Tie EvenGaps(Maker& m, double gap, double velocity) {
  const int balls = 2 + m.Below(2);
  for (int i = 0; i < balls; ++i) m.Row(1, gap);
  m.At(0).velocity = -velocity;
  m.Last().velocity = velocity;
  m.Neighbours();
  m.WallLeft(0, gap);
  m.WallRight(m.last(), gap);
  Alike(m);
  m.s.end_time = gap / velocity * m.Uniform(2, 6);
  return {m.last(), -1, gap};
}

// Two pairs that have nothing to do with each other, until much later.
Tie TwoPairs(Maker& m, double gap, double velocity) {
  m.Ball(0, velocity);
  m.Row(1, gap);
  m.Row(1, 50 * gap);
  m.Last().velocity = velocity;
  m.Row(1, gap);
  m.Neighbours();
  if (m.Chance(0.5)) Alike(m);
  m.s.end_time = gap / velocity * m.Uniform(1.5, 40);
  return {3, 1, gap};
}

// A ball that two others, one behind the other in a plane view, strike together.
Tie TwoStrikers(Maker& m, double gap, double velocity) {
  m.Ball(0, velocity);
  m.Ball(0, velocity);
  m.Row(1, gap);
  m.Pair(0, 2);
  m.Pair(1, 2);
  if (m.Chance(0.7)) Alike(m);
  m.s.end_time = gap / velocity + m.Uniform(0.002, 0.01);
  return {1, -1, gap};
}

Tie TieOf(Maker& m) {
  m.restitution = {0.1, 0.95};
  m.stiffness = {1e6, 1e8};
  // Mostly numbers of few bits: then gaps are equal to the last one.
  const bool exact = m.Chance(0.6);
  if (exact) m.radius = 1.0 / 64;
  const double any = m.Log(1e-5, 0.1), velocity = m.Uniform(0.1, 2);
  const double gap = exact ? std::ceil(any * 0x1p24) / 0x1p24 : any;
  switch (m.Below(5)) {
    case 0:
      return TwoOnOneFloor(m, gap);
    case 1:
      return BothEnds(m, gap, velocity);
    case 2:
      return EvenGaps(m, gap, velocity);
    case 3:
      return TwoPairs(m, gap, velocity);
    default:
      return TwoStrikers(m, gap, velocity);
  }
}

}  // namespace

void Box(Maker& m) {
  m.restitution = {0.4, 0.99};
  const double width = m.Log(1e-3, 0.5), velocity = m.Uniform(0.1, 3);
  const int balls = 1 + m.Below(2);
  for (int i = 0; i < balls; ++i) m.Row(1, width / balls);
  m.At(0).velocity = velocity * m.Sign();
  m.WallLeft(0, width / balls / 2);
  m.WallRight(m.last(), width / balls / 2);
  m.Neighbours();
  if (m.Chance(0.3)) m.Gravity();
  m.s.end_time = m.Log(2, 20) * width / velocity;
}

void Gas(Maker& m) {
  m.restitution = {0.5, 0.98};
  m.stiffness = {1e6, 1e9};
  const int balls = 8 + m.Below(13);
  const double gap = m.Log(1e-3, 0.1);
  for (int i = 0; i < balls; ++i) {
    m.Row(1, gap * m.Uniform(0.2, 1.8));
    m.Last().velocity = m.Uniform(-1, 1);
  }
  m.Neighbours();
  m.WallLeft(0, gap);
  m.WallRight(m.last(), gap);
  m.s.end_time = m.Uniform(1, 4) * gap;
}

void Held(Maker& m) {
  const int balls = 1 + m.Below(3);
  const double gap = m.Chance(0.3) ? 0 : m.Log(1e-5, 1e-2);
  m.Row(1);
  m.At(0).fixed = true;
  for (int i = 0; i < balls; ++i) m.Row(1, gap * m.Uniform(0.5, 1.5));
  m.Last().velocity = m.Uniform(-2, -0.1);
  m.Neighbours();
  if (m.Chance(0.5)) {
    m.Row(1, m.Log(1e-5, 1e-2));
    m.Last().fixed = true;
    m.Neighbours(m.last() - 1);
  }
  if (m.Chance(0.4)) m.Gravity();
  m.s.end_time = m.Log(3e-3, 0.1);
}

void Grazing(Maker& m) {
  const double v = m.Uniform(0.05, 1), part = m.Log(1e-10, 1e-2), g = m.Log(5, 500);
  if (m.Chance(0.6)) {  // Thrown up so high that it almost, or barely, reaches the ceiling.
    m.Ball(0, v);
    m.WallRight(0, v * v / (2 * g) * (1 - part * m.Sign()));
    m.Force(0, -g * m.At(0).mass);
    m.s.end_time = m.Uniform(1.2, 1.9) * v / g;
    return;
  }
  m.Row(2 + m.Below(3));  // Touches, and is pulled apart; some come back.
  m.Neighbours();
  m.At(0).velocity = m.Chance(0.5) ? -v * part : -v;
  if (m.Chance(0.6)) m.Force(m.last(), m.Log(1, 100));
  const double begin = m.Uniform(0, 2e-3);
  if (m.Chance(0.6)) m.Step(0, m.Log(10, 1000), begin);
  m.s.end_time = m.Log(5e-3, 0.03);
}

void Ring(Maker& m) {
  m.stiffness = {1e5, 1e7};
  const double v = m.Uniform(0.2, 2), thin = m.Log(1e-6, 1e-4);
  m.Ball(0, v);
  m.radius = thin;  // A sheet: the two beside it touch each other around it.
  m.Row(1, m.Chance(0.5) ? 0 : m.Log(1e-6, 1e-4));
  m.radius = 0.02;
  m.Row(1);
  m.Neighbours();
  m.Pair(0, 2);
  if (m.Chance(0.5)) {  // A second ball beside the first, which pushes both others.
    const int fourth = m.Ball(m.At(0).position - m.Log(1e-6, 1e-4), v);
    m.Pair(fourth, 1);
    m.Pair(fourth, 2);
  }
  if (m.Chance(0.4)) m.WallRight(2, m.Log(1e-6, 1e-4));
  m.s.end_time = m.Uniform(0.005, 0.02);
}

void Ties(Maker& m) { TieOf(m); }

void NearGaps(Maker& m) {
  const Tie tie = TieOf(m);
  m.At(tie.second).position += tie.away * std::min(m.Log(1e-12, 1e-4), tie.gap / 2);
}

void NearSpeeds(Maker& m) {
  const double v = m.Uniform(0.1, 2), e = m.Uniform(0.3, 0.95);
  const int balls = 3 + m.Below(4), strikers = 2 + m.Below(balls - 2);
  m.Row(balls, m.Chance(0.8) ? 0 : m.Log(1e-7, 1e-4));
  m.Neighbours();
  if (m.Chance(0.7)) Alike(m);
  for (Contact& c : m.s.contacts) c.restitution = m.Chance(0.7) ? e : c.restitution;
  for (int i = 0; i < strikers; ++i) m.At(i).velocity = v;
  const double more = m.Log(1e-11, 1e-7), sign = m.Chance(0.8) ? 1 : -1;
  for (int i = 0; i + 1 < strikers; ++i) m.At(i).velocity += sign * more * (strikers - 1 - i);
  m.s.end_time = m.Uniform(0.003, 0.02);
}

}  // namespace contact::testing
