// What contacts of machines do: touch at one instant, rest, are disturbed, let go, are cut.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "testing/cases.h"

namespace contact {
namespace {

using testing::Ball;
using testing::Record;
using testing::RunAndRecord;

// A ball of 1 kg that is put on a floor under −10 N, and gets a step of `force` at 0.5 s.
Scenario Placed(double restitution, double force) {
  Scenario s;
  s.bodies = {Ball(0.05, 0, 1)};
  s.contacts = {{.name = "floor", .right = 0, .stiffness = 1e7, .restitution = restitution}};
  s.loads = {{.body = 0, .constant = -10}, {.body = 0, .begin = 0.5, .constant = force}};
  s.end_time = 1;
  return s;
}

// A ball of 0.25 kg on a table of 10 t, which a force moves to and fro.
Scenario Shaker() {
  Scenario s;
  s.bodies = {{.name = "table", .mass = 1e4, .radius = 0.01, .velocity = 0.1329430359},
              {.name = "ball", .mass = 0.24763, .radius = 0.02, .position = 0.030050642}};
  s.contacts = {
      {.name = "table-ball", .left = 0, .right = 1, .stiffness = 4970850, .restitution = 0.7372}};
  s.loads = {{.body = 0, .amplitude = -106875.44, .angular_frequency = 80.391905},
             {.body = 1, .constant = -9.80665 * 0.24763}};
  return s;
}

const Cycle* First(const Record& r, Cycle::Status status) {
  const auto found = std::ranges::find(r.cycles, status, &Cycle::status);
  return found == r.cycles.end() ? nullptr : &*found;
}

TEST(Ties, TwoTouchesAtOneInstantAreTwoCollisions) {
  Scenario s;
  s.bodies = {Ball(0, 1), Ball(0.1001, 0), Ball(0.2002, -1)};
  for (int i = 0; i < 2; ++i) {
    s.contacts.push_back({.name = std::to_string(i),
                          .left = i,
                          .right = i + 1,
                          .stiffness = 1e7,
                          .restitution = 0.6,
                          .damping = DampingLaw::kExact});
  }
  s.end_time = 0.005;
  const Record r = RunAndRecord(s);
  EXPECT_TRUE(r.outcome.all_converged);
  EXPECT_NEAR(r.outcome.velocities[0], -0.6, 1e-9);
  EXPECT_NEAR(r.outcome.velocities[1], 0, 1e-9);
  EXPECT_NEAR(r.outcome.velocities[2], 0.6, 1e-9);
}

TEST(Ties, TouchingBallsOfAlmostOneSpeedAreNotGlued) {
  const auto cradle = [](double second) {
    Scenario s = testing::Chain(std::vector<double>(5, 0.5), std::vector<double>(4, 1e8),
                                std::vector<double>(4, 0.9), 1.41421356237, 0.02);
    s.bodies[1].velocity = second;
    return RunAndRecord(s);
  };
  const Record near = cradle(1.41421356), same = cradle(1.41421356237);
  EXPECT_TRUE(near.outcome.all_converged);
  const double published[] = {-0.139, 0.156, 0.416, 0.876, 1.520};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(near.outcome.velocities[i], published[i], 5e-4);
    EXPECT_NEAR(near.outcome.velocities[i], same.outcome.velocities[i], 1e-6);
  }
}

// r = ε² α²/(2 (α − ln(1 + α))) of the energy k δ_s^2.5/2.5: what the collision would have
// returned.
TEST(Rest, AReleaseWithoutALoadGivesBackWhatItsCollisionWouldHave) {
  const Record r = RunAndRecord(Placed(0.5, 10));
  const Cycle* released = First(r, Cycle::Status::kReleased);
  ASSERT_NE(released, nullptr);
  EXPECT_EQ(released->start_time, 0.5);
  EXPECT_EQ(released->end, Cycle::End::kSeparation);
  EXPECT_NEAR(released->work_compression, 0, 1e-9);
  const double alpha = 1.43275053327;
  const double part = 0.25 * alpha * alpha / (2 * (alpha - std::log1p(alpha)));
  const double stored = 1e7 * std::pow(released->start_deformation, 2.5) / 2.5;
  EXPECT_NEAR(-released->work_restitution / stored, part, 1e-6);
  EXPECT_LT(released->identity_residual, 1e-7);
}

// Round-off makes balls that lie on each other swing without end.
TEST(Rest, CostsNothingOnceItSleeps) {
  for (const int balls : {1, 3}) {
    for (const double restitution : {0.3, 0.9}) {
      Scenario s = testing::Column(balls, 1e7, restitution, 0.001);
      s.end_time = 3;
      const Record soon = RunAndRecord(s);
      s.end_time = 300;
      const Record late = RunAndRecord(s);
      EXPECT_LT(late.outcome.steps, soon.outcome.steps + 500) << balls << " " << restitution;
      EXPECT_LT(late.outcome.energy_residual, 1e-10);
      EXPECT_LT(late.outcome.momentum_residual, 1e-10);
      const Body& lowest = s.bodies.back();
      const double depth = late.outcome.positions.back() - lowest.position - 0.001;
      EXPECT_NEAR(depth / std::pow(balls * lowest.mass * 9.81 / 1e7, 2.0 / 3), 1, 1e-9);
    }
  }
}

// What wakes it does not depend on how long it slept.
TEST(Rest, WakesAsTheSameHoweverLongItSlept) {
  const auto wakes = [](double at) {
    Scenario s = Placed(0.7, -20);
    s.loads[1].begin = at;
    s.end_time = at + 0.5;
    return RunAndRecord(s);
  };
  const Record soon = wakes(1), late = wakes(1000);
  EXPECT_LT(late.outcome.steps, soon.outcome.steps + 500);
  ASSERT_EQ(late.cycles.size(), soon.cycles.size());
  ASSERT_GT(soon.cycles.back().start_time, 0.9);
  for (std::size_t i = 0; i < soon.cycles.size(); ++i) {
    const Cycle &a = soon.cycles[i], &b = late.cycles[i];
    EXPECT_EQ(b.status, a.status);
    if (a.status == Cycle::Status::kConverged) {
      EXPECT_NEAR(b.mu / a.mu, 1, 1e-6);
    }
    if (a.start_time > 0.9) {
      EXPECT_NEAR(b.start_time - 1000, a.start_time - 1, 1e-9);
    }
  }
}

TEST(Rest, ALoadThatLiftsEndsItAtItsBeginAndIsAnAnswer) {
  const Record r = RunAndRecord(Placed(0.5, 20));
  EXPECT_TRUE(r.outcome.all_converged);
  ASSERT_NE(First(r, Cycle::Status::kReleased), nullptr);
  EXPECT_EQ(r.cycles.back().start_time, 0.5);
  EXPECT_NEAR(r.cycles.back().end_time, 0.5039, 2e-4);  // Elastic it would be 0.5034 s.
}

TEST(Rest, MoreWeightBeginsACycleWithItsRestitution) {
  const Record r = RunAndRecord(Placed(0.5, -100));
  EXPECT_TRUE(r.outcome.all_converged);
  const auto struck = std::ranges::find(r.cycles, 0.5, &Cycle::start_time);
  ASSERT_NE(struck, r.cycles.end());
  EXPECT_EQ(struck->status, Cycle::Status::kConverged);
  EXPECT_NEAR(struck->restitution_out, 0.5, 1e-8);
  EXPECT_LT(r.outcome.worst_identity_residual, 1e-8);
  EXPECT_LT(r.outcome.momentum_residual, 1e-12);
  EXPECT_LT(r.outcome.steps, 10'000);
}

// A nearly plastic blow that creeps longer than the run: what it was does not depend on the end.
TEST(End, OfTheRunHidesAndChangesNothing) {
  Scenario s;
  s.bodies = {Ball(1, 1, 1)};
  s.contacts = {{.name = "floor", .right = 0, .stiffness = 1e6, .restitution = 0.01}};
  s.loads = {{.body = 0, .constant = -9.8}};
  std::vector<double> peaks;
  for (const double end : {2.0, 5.0, 10.0}) {
    s.end_time = end;
    const Record r = RunAndRecord(s);
    EXPECT_EQ(r.outcome.time, end);
    EXPECT_TRUE(r.outcome.all_converged);
    for (const Cycle& c : r.cycles) EXPECT_LE(c.end_time, end);
    EXPECT_EQ(r.outcome.cut_cycles, 1);
    EXPECT_EQ(r.cycles[0].status, Cycle::Status::kCut);
    EXPECT_TRUE(std::isnan(r.cycles[0].restitution_out));
    peaks.push_back(r.cycles[0].peak_force);
  }
  EXPECT_NEAR(peaks[1] / peaks[0], 1, 1e-6);
  EXPECT_NEAR(peaks[2] / peaks[0], 1, 1e-6);
}

// A pin that a ramp presses against a stop rings, rests while it is held, and is let go.
Record PressedBall(double restitution) {
  Scenario s;
  s.bodies = {Ball(-0.05, 0, 0.01)};
  s.contacts = {
      {.name = "stop", .left = 0, .stiffness = 1.5e8, .exponent = 1, .restitution = restitution}};
  s.loads = {{.body = 0, .begin = 0, .end = 0.03, .slope = 200},
             {.body = 0, .begin = 0.03, .end = 0.04, .constant = 6},
             {.body = 0, .begin = 0.04, .end = 0.07, .constant = 6, .slope = -200}};
  s.end_time = 0.08;
  return RunAndRecord(s);
}

TEST(Loads, WhatTheyHoldIsLimitedAndWhatTheyLetGoIsReleased) {
  for (const double restitution : {0.3, 0.6, 0.8}) {
    const Record r = PressedBall(restitution);
    EXPECT_TRUE(r.outcome.all_converged);
    EXPECT_LT(r.outcome.steps, 400'000);
    ASSERT_FALSE(r.groups.empty());
    const Group& press = r.groups.front();
    EXPECT_EQ(press.status, Cycle::Status::kLimited);
    EXPECT_LT(press.too_little.restitution, restitution);  // At μ = 0: the load keeps the rest.
    const Cycle* release = First(r, Cycle::Status::kReleased);
    ASSERT_NE(release, nullptr);
    EXPECT_NEAR(release->start_time, 0.04, 1e-6);
    EXPECT_NEAR(-release->work_restitution, 6 * 6 / (2 * 1.5e8), 1e-3 * 6 * 6 / (2 * 1.5e8));
    EXPECT_LT(r.outcome.momentum_residual, 1e-8);
  }
}

TEST(TheEnd, MarksGroupsThatOverlapOneThatItCuts) {
  Scenario s = testing::TripleChain();
  const Record whole = RunAndRecord(s);
  ASSERT_GE(whole.groups.size(), 2U);
  for (const Group& g : whole.groups) EXPECT_FALSE(g.beside_cut);
  s.end_time = (whole.groups[0].end_time + whole.groups[1].end_time) / 2;
  const Record cut = RunAndRecord(s);
  ASSERT_EQ(cut.groups.size(), whole.groups.size());
  for (const Group& g : cut.groups) EXPECT_TRUE(g.beside_cut);
}

// The cycle after the trough gives back too much whatever its μ. With a later end it joins the
// group before, of which the μ is ten times as large then.
TEST(TheEnd, MarksAGroupWhoseNextCycleItCuts) {
  Scenario s = Shaker();
  s.end_time = 0.3964;
  const Record cut = RunAndRecord(s);
  s.end_time = 0.519284;
  const Record whole = RunAndRecord(s);
  ASSERT_EQ(cut.groups.size(), 12U);
  for (std::size_t i = 0; i < cut.groups.size(); ++i) {
    EXPECT_EQ(cut.groups[i].beside_cut, i >= 9) << i + 1;
  }
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(cut.groups[i].mu / whole.groups[i].mu, 1, 1e-6) << i + 1;
  }
  EXPECT_NEAR(cut.groups[10].mu, 4.3251e7, 1e4);
  EXPECT_NEAR(whole.groups[10].mu, 4.4372e8, 1e5);
  EXPECT_EQ(whole.groups[10].growth, Growth::kTooMuch);
  EXPECT_FALSE(whole.groups[10].beside_cut);
}

TEST(TheEnd, LeavesRowsOfALawThatEndBeforeItWhatTheyAre) {
  Scenario s = testing::TripleChain();
  s.contacts[0].damping = DampingLaw::kExact;
  const Record whole = RunAndRecord(s);
  s.end_time = (whole.groups[0].end_time + whole.groups[1].end_time) / 2;
  for (const Cycle& c : RunAndRecord(s).cycles) EXPECT_NE(c.status, Cycle::Status::kNotConverged);
}

TEST(FixedSteps, SolveTheChainAtEachAndMissItsIdentityByTheirFourthPower) {
  const auto missed = [](double step) {
    Scenario s = testing::TripleChain();
    s.solver.fixed_step = step;
    const Record r = RunAndRecord(s);
    EXPECT_TRUE(r.outcome.all_converged) << step;
    return r.outcome.worst_identity_residual;
  };
  const double coarse = missed(4e-6), fine = missed(1e-6);
  EXPECT_NEAR(std::log(coarse / fine) / std::log(4), 4, 0.5);
  missed(1e-7);
}

}  // namespace
}  // namespace contact
