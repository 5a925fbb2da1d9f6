// Bodies that move as given, and plays with two sides.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "simulation/model/derived.h"
#include "testing/cases.h"

namespace contact {
namespace {

using testing::Record;
using testing::RunAndRecord;

constexpr double kGravity = 9.81;

// A ball above a floor, both sides of which are points; the floor is body 1, fixed.
Scenario BallOnFloor(double height, double velocity, double stiffness, double exponent,
                     double restitution) {
  Scenario s;
  s.bodies = {{.name = "ball", .mass = 0.1, .position = height, .velocity = velocity},
              {.name = "floor", .fixed = true}};
  s.contacts = {{.name = "C",
                 .left = 1,
                 .right = 0,
                 .stiffness = stiffness,
                 .exponent = exponent,
                 .restitution = restitution}};
  s.loads = {{.body = 0, .constant = -kGravity * 0.1}};
  s.end_time = 0.5;
  return s;
}

void Drive1(Scenario* s, const Drive& drive) {
  s->drives = {drive};
  s->drives[0].body = 1;
  const DrivenMotion start = MotionAt(drive, 0);
  s->bodies[1].position = start.position;
  s->bodies[1].velocity = start.velocity;
}

void ExpectSameLedger(const Record& a, const Record& b, double tolerance) {
  ASSERT_EQ(a.cycles.size(), b.cycles.size());
  ASSERT_FALSE(a.cycles.empty());
  for (std::size_t i = 0; i < a.cycles.size(); ++i) {
    EXPECT_NEAR(a.cycles[i].start_time, b.cycles[i].start_time, tolerance) << i;
    EXPECT_NEAR(a.cycles[i].mu / b.cycles[i].mu, 1, 10 * tolerance) << i;
    EXPECT_NEAR(a.cycles[i].peak_force / b.cycles[i].peak_force, 1, 10 * tolerance) << i;
    EXPECT_EQ(a.cycles[i].status, b.cycles[i].status) << i;
  }
}

// x″ = ω₀² (A sin ωt − x) from rest: x = A ω₀²/(ω₀² − ω²) (sin ωt − (ω/ω₀) sin ω₀t).
TEST(Driven, ASupportToASwingingBaseMovesAsItsClosedForm) {
  const double natural = 20, omega = 33, amplitude = 2e-3;
  Scenario s;
  s.bodies = {{.name = "mass", .mass = 3}, {.name = "base", .fixed = true}};
  s.supports = {{.body = 0, .other = 1, .stiffness = 3 * natural * natural}};
  s.end_time = 1.7;
  Drive1(&s, {.amplitude = amplitude, .angular_frequency = omega});
  const Record r = RunAndRecord(s);
  const double t = s.end_time, ratio = natural * natural / (natural * natural - omega * omega);
  EXPECT_NEAR(r.outcome.positions[0],
              amplitude * ratio * (std::sin(omega * t) - omega / natural * std::sin(natural * t)),
              1e-9 * amplitude);
  EXPECT_NEAR(r.outcome.positions[1], amplitude * std::sin(omega * t), 1e-15);
  EXPECT_LT(r.outcome.energy_residual, 1e-11);  // With the work of the drive.
  EXPECT_LT(r.outcome.momentum_residual, 1e-11);
}

TEST(Driven, AUniformMotionIsAFrameOfReference) {
  Scenario s = BallOnFloor(0.01, -0.3, 1e6, 1.5, 0.6);
  s.end_time = 0.1;
  const Record still = RunAndRecord(s);
  const double speed = 1.75;
  Scenario moving = s;
  moving.bodies[0].velocity += speed;
  Drive1(&moving, {.velocity = speed});
  const Record r = RunAndRecord(moving);
  ExpectSameLedger(r, still, 1e-8);
  EXPECT_NEAR(r.outcome.positions[0], still.outcome.positions[0] + speed * s.end_time, 1e-11);
  EXPECT_LT(r.outcome.energy_residual, 1e-11);
}

// In the frame of a table that swings, the table stands and a load −m ẍ acts.
TEST(Driven, AShakingTableIsALoadInItsFrame) {
  for (const double exponent : {1.0, 1.5}) {
    Scenario s = BallOnFloor(0.002, 0, 1e7, exponent, 0.5);
    const double amplitude = 1e-3, omega = 130;
    Scenario shaken = s;
    shaken.bodies[0].velocity += amplitude * omega;
    Drive1(&shaken, {.amplitude = amplitude, .angular_frequency = omega});
    s.loads.push_back(
        {.body = 0, .amplitude = 0.1 * amplitude * omega * omega, .angular_frequency = omega});
    const Record table = RunAndRecord(shaken), load = RunAndRecord(s);
    ExpectSameLedger(table, load, 1e-8);
    EXPECT_GT(table.cycles.size(), 8U);
    EXPECT_TRUE(table.outcome.all_converged);
    EXPECT_LT(table.outcome.energy_residual, 1e-10);
    EXPECT_LT(table.outcome.momentum_residual, 1e-10);
    EXPECT_LT(table.outcome.worst_identity_residual, 1e-9);
  }
}

// What creeps on a table that does not throw it costs 3.4 times the steps of the same load, and 34
// times if Euler's method takes the table for a motion of its own.
TEST(Driven, ADampedContactFollowsItsTableInStepsLikeThoseOfALoad) {
  const double amplitude = 9e-4, omega = 69;
  Scenario s = BallOnFloor(0, 0, 1.8e7, 1.5, 1);
  s.contacts[0].damping = DampingLaw::kGiven, s.contacts[0].mu = 1e12;
  Scenario shaken = s;
  shaken.bodies[0].velocity = amplitude * omega;
  Drive1(&shaken, {.amplitude = amplitude, .angular_frequency = omega});
  s.loads.push_back(
      {.body = 0, .amplitude = 0.1 * amplitude * omega * omega, .angular_frequency = omega});
  const Record table = RunAndRecord(shaken), load = RunAndRecord(s);
  EXPECT_LT(table.outcome.steps, 6 * load.outcome.steps);
  ASSERT_EQ(table.cycles.size(), load.cycles.size());
  for (std::size_t i = 0; i + 1 < table.cycles.size(); ++i) {  // The end cuts the last.
    EXPECT_NEAR(table.cycles[i].max_deformation / load.cycles[i].max_deformation, 1, 1e-9) << i;
  }
  EXPECT_LT(table.outcome.energy_residual, 1e-9);
}

// A table that rises to just above, or just below, what hangs there.
TEST(Driven, AGrazingTouchIsFound) {
  for (const double beyond : {1e-3, 1e-4, 1e-5}) {
    for (const bool reaches : {true, false}) {
      Scenario s = BallOnFloor(1e-3 * (1 + (reaches ? -beyond : beyond)), 0, 1e8, 1.5, 0.8);
      s.loads.clear();
      s.end_time = 0.03;
      Drive1(&s, {.amplitude = 1e-3, .angular_frequency = 2 * std::numbers::pi / 0.04});
      const Record r = RunAndRecord(s);
      EXPECT_EQ(r.cycles.empty(), !reaches) << beyond;
      EXPECT_TRUE(r.outcome.all_converged) << beyond;
      EXPECT_EQ(r.outcome.velocities[0] > 0, reaches) << beyond;
    }
  }
}

// Pieces with jumps of acceleration, as of tables: a floor that starts, goes on and stops.
TEST(Driven, AFloorThatStartsAndStopsThrowsWhatLiesOnIt) {
  Scenario s = BallOnFloor(0, 0, 1e8, 1.5, 0.5);
  s.bodies[0].position = -std::pow(0.1 * kGravity / 1e8, 1 / 1.5);
  s.starts_at_rest = true;
  const double rise = 2, start = 0.1, stop = 0.2;  // 2 m/s² up to 0.2 m/s, then at rest at once.
  const double last = rise * (stop - start);
  s.drives = {{.body = 1, .end = start},
              {.body = 1, .begin = start, .end = stop, .acceleration = rise},
              {.body = 1,
               .begin = stop,
               .end = stop + 1e-4,
               .position = rise * (stop - start) * (stop - start) / 2,
               .velocity = last,
               .acceleration = -last / 1e-4},
              {.body = 1,
               .begin = stop + 1e-4,
               .position = rise * (stop - start) * (stop - start) / 2 + last * 1e-4 / 2}};
  s.end_time = stop + 0.02;
  const Record r = RunAndRecord(s);
  EXPECT_NEAR(r.outcome.velocities[0], last - kGravity * 0.02, 0.02 * last);
  EXPECT_LT(r.outcome.energy_residual, 1e-9);
}

// In a free box every impact leaves ε of the relative speed, and the masses do not matter.
TEST(Play, AHundredImpactsInABoxLeaveEveryTimeTheSamePart) {
  const double restitution = 0.97;
  Scenario s;
  s.bodies = {{.name = "ball", .mass = 1, .velocity = 1}, {.name = "box", .mass = 2}};
  for (const bool left : {true, false}) {
    s.contacts.push_back({.name = left ? "left" : "right",
                          .left = left ? 1 : 0,
                          .right = left ? 0 : 1,
                          .play = 0.01,
                          .stiffness = 1e10,
                          .restitution = restitution});
  }
  s.end_time = 13.5;
  const Record r = RunAndRecord(s);
  ASSERT_GE(r.cycles.size(), 100U);
  double speed = 1;
  for (std::size_t i = 0; i < 100; ++i, speed *= restitution) {
    EXPECT_NEAR(r.cycles[i].approach_velocity / speed, 1, 1e-8) << i;
    EXPECT_EQ(r.cycles[i].contact, i % 2 == 0 ? 1 : 0) << i;
  }
  // From one side to the other, but for the time in contact.
  const double flight = r.cycles[1].start_time - r.cycles[0].end_time;
  EXPECT_NEAR(flight * restitution, 0.02, 1e-12);
  EXPECT_TRUE(r.outcome.all_converged);
}

// A stop on both sides of a part is a wall on its left and one on its right.
TEST(Play, BesideAWallIsTwoWalls) {
  Scenario s;
  s.bodies = {{.name = "part", .mass = 0.2, .radius = 0.01, .position = 0.1, .velocity = 0.7}};
  for (const bool left : {true, false}) {
    Contact side{.name = left ? "left" : "right", .stiffness = 1e7, .restitution = 0.8};
    (left ? side.right : side.left) = 0;
    side.wall_position = left ? 0.1 - 0.003 - 0.01 : 0.1 + 0.003 + 0.01;
    s.contacts.push_back(side);
  }
  s.end_time = 0.1;
  Scenario slot = s;
  for (Contact& side : slot.contacts) {
    side.wall_position = 0.1;
    side.play = 0.003;
  }
  ExpectSameLedger(RunAndRecord(slot), RunAndRecord(s), 1e-10);
}

}  // namespace
}  // namespace contact
