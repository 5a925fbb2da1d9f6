// Bodies that are driven, shaken, held by springs or pressed from the start are solved in parts,
// and move as all together do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>

#include "simulation/clusters/both_ways.h"
#include "simulation/model/derived.h"
#include "simulation/motion/state.h"
#include "testing/cases.h"

namespace contact {
namespace {

using testing::Gas;
using testing::Record;
using testing::RunAndRecord;
using testing::RunTogether;

// The wall to the left of a gas becomes a driven body.
void DriveWall(Scenario* s, Drive drive) {
  drive.body = static_cast<int>(s->bodies.size());
  const DrivenMotion start = MotionAt(drive, 0);
  s->bodies.push_back(
      {.name = "table", .position = start.position, .velocity = start.velocity, .fixed = true});
  s->contacts[0].left = drive.body;
  s->drives.push_back(drive);
}

Scenario ShakenGas(int balls, double stiffness, unsigned seed) {
  Scenario s = Gas(balls, stiffness, seed);
  DriveWall(&s, {.amplitude = 1e-3, .angular_frequency = 2 * std::numbers::pi * 100});
  return s;
}

void ExpectAsTogether(const Scenario& s, double time, double mu) {
  ASSERT_TRUE(MayPart(s));
  const Record parts = RunAndRecord(s), whole = RunTogether(s);
  testing::ExpectClosedBalances(parts.outcome);
  testing::ExpectClosedBalances(whole.outcome);
  ASSERT_GT(whole.cycles.size(), 5U);
  testing::ExpectSame(parts, whole, time, mu);
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    EXPECT_NEAR(parts.outcome.positions[b], whole.outcome.positions[b], 10 * time) << b;
  }
}

TEST(HeldClusters, AShakenGasMovesAsAllTogetherDo) {
  for (unsigned seed = 1; seed <= 3; ++seed) ExpectAsTogether(ShakenGas(30, 1e6, seed), 1e-9, 1e-6);
}

TEST(HeldClusters, AWallThatATableMovesIsMetWhereItIs) {
  Scenario s = Gas(20, 1e7, 2);
  const double first = 0.01, speed = 0.3;
  DriveWall(&s, {.end = first, .acceleration = speed / first});
  const DrivenMotion there = MotionAt(s.drives[0], first);
  s.drives.push_back({.body = s.drives[0].body,
                      .begin = first,
                      .position = there.position,
                      .velocity = there.velocity,
                      .jerk = -50});
  ExpectAsTogether(s, 1e-9, 1e-6);
}

TEST(HeldClusters, AGasUnderALoadThatChangesMovesAsAllTogetherDo) {
  Scenario s = Gas(20, 1e7, 3);
  s.loads.push_back({.body = 4, .begin = 0.01, .end = 0.012, .constant = 20});
  s.loads.push_back({.body = 9, .amplitude = 5, .angular_frequency = 400, .phase = 1});
  s.loads.push_back({.body = 9, .constant = -1});
  ExpectAsTogether(s, 1e-9, 1e-6);
}

TEST(HeldClusters, AGasWithBodiesOnSpringsMovesAsAllTogetherDo) {
  Scenario s = Gas(20, 1e7, 4);
  const auto on = [&](int body, int other) {
    const auto place = [&](int b) {
      return b == kNone ? 0 : s.bodies[static_cast<std::size_t>(b)].position;
    };
    s.supports.push_back({.body = body,
                          .other = other,
                          .stiffness = 3e3,
                          .damping = 0.5,
                          .rest_position = place(body) - place(other)});
  };
  on(3, kNone);
  on(10, 11);
  s.supports.back().higher = {0, 1e8};
  ExpectAsTogether(s, 1e-9, 1e-6);
}

TEST(HeldClusters, ARowThatIsPressedAtTheStartMovesAsAllTogetherDo) {
  Scenario s = Gas(12, 1e7, 5);
  for (int i = 4; i < 7; ++i) {  // Three balls that press each other, at rest.
    Body& ball = s.bodies[static_cast<std::size_t>(i)];
    ball.position = s.bodies[3].position + (i - 3) * 0.01999;
    ball.velocity = s.bodies[3].velocity;
  }
  ExpectAsTogether(s, 1e-9, 1e-6);
}

// Every sample, with the energies and the work of the table.
TEST(HeldClusters, SamplesAreThoseOfAllTogether) {
  Scenario s = ShakenGas(15, 1e6, 2);
  s.loads.push_back({.body = 5, .amplitude = 2, .angular_frequency = 300});
  s.supports.push_back(
      {.body = 8, .stiffness = 1e3, .damping = 2, .rest_position = s.bodies[8].position});
  s.sample_interval = s.end_time / 300;
  const Record parts = RunAndRecord(s), whole = RunTogether(s);
  ASSERT_EQ(parts.rows(), whole.rows());
  double worst = 0;
  int where = 0, at = 0;
  for (int row = 0; row < parts.rows(); ++row) {
    for (int column = 0; column < parts.columns; ++column) {
      const double scale = std::max(1.0, std::abs(whole.Sample(row, column)));
      const double off = std::abs(parts.Sample(row, column) - whole.Sample(row, column)) / scale;
      if (off > worst) worst = off, where = column, at = row;
    }
  }
  EXPECT_LT(worst, 1e-6) << where << " of " << parts.columns << " row " << at;
}

// A gas with some of all that holds and moves bodies.
Scenario RandomlyHeld(unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  const auto one_in = [&](unsigned count) { return random() % count == 0; };
  const int balls = 8 + static_cast<int>(random() % 17);
  Scenario s = Gas(balls, std::pow(10, between(6, 9)), seed, std::pow(10, between(-0.8, 0)));
  const double restitution = between(0.4, 0.95);
  for (Contact& contact : s.contacts) contact.restitution = restitution;
  const auto position = [&](int b) {
    return b == kNone ? 0 : s.bodies[static_cast<std::size_t>(b)].position;
  };
  if (!one_in(3)) {
    DriveWall(&s, {.velocity = between(-0.1, 0.1),
                   .amplitude = std::pow(10, between(-4, -2.7)),
                   .angular_frequency = std::pow(10, between(1, 3.3)),
                   .phase = between(0, 6)});
  }
  const double gravity = one_in(2) ? between(-10, 10) : 0;
  for (int i = 0; i < balls; ++i) {
    const double mass = s.bodies[static_cast<std::size_t>(i)].mass;
    if (gravity != 0) s.loads.push_back({.body = i, .constant = gravity * mass});
    if (one_in(10)) {
      const double begin = between(0, 0.03);
      s.loads.push_back({.body = i,
                         .begin = begin,
                         .end = one_in(2) ? begin + between(1e-4, 5e-3) : kNever,
                         .constant = between(-3, 3)});
    }
    if (one_in(10)) {
      s.loads.push_back({.body = i, .amplitude = 1, .angular_frequency = between(10, 2000)});
    }
    if (one_in(8)) {
      const bool to_table = std::ssize(s.bodies) > balls && one_in(3);
      const int other = to_table ? balls : i + 1 < balls && one_in(2) ? i + 1 : kNone;
      s.supports.push_back({.body = i,
                            .other = other,
                            .stiffness = std::pow(10, between(1, 4.5)),
                            .damping = between(0, 1),
                            .rest_position = position(i) - position(other)});
    }
  }
  if (one_in(2)) {  // Two that press each other.
    s.bodies[4].position = s.bodies[3].position + 0.02 - between(0, 1e-5);
  }
  s.solver.max_steps = 400'000;
  return s;
}

// The same cycles but in a few, where a tail is chaotic or two sets of μ solve the same groups.
TEST(HeldClusters, RandomOnesKeepTheirBalancesAndTheirCycles) {
  if (!testing::kOptimized) GTEST_SKIP() << "takes minutes";
  const testing::Both both = testing::RunBothWays(RandomlyHeld, 60, 1e-8);
  EXPECT_GE(both.finished, 55);
  EXPECT_GE(both.same, both.finished - 4);
}

}  // namespace
}  // namespace contact
