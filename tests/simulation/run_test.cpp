#include "simulation/run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "simulation/model/derived.h"
#include "testing/cases.h"

namespace contact {
namespace {

using testing::Record;
using testing::RunAndRecord;

// With a given α: rebound speed and deepest point of an isolated collision, any n, k, m, v.
TEST(Run, AnIsolatedCollisionSatisfiesItsClosedForm) {
  for (const double n : {1.0, 1.5, 3.0}) {
    for (double e = 0.05; e < 0.995; e += 0.094) {
      const double m = 0.3, v = 2, k = 5e7;
      Scenario s = testing::Collision(m, v, k, n, e);
      s.contacts[0].damping = DampingLaw::kGiven;
      const double alpha = DampingCoefficient(DampingLaw::kFlores, e);
      s.contacts[0].mu = alpha * k / v;
      const Record r = RunAndRecord(s);
      ASSERT_EQ(r.cycles.size(), 1u);
      const Cycle& c = r.cycles[0];
      const double delivered = DeliveredRestitution(alpha);
      EXPECT_NEAR(c.restitution_out, delivered, 1e-9) << n << " " << e;
      EXPECT_NEAR(r.outcome.velocities[0], -delivered * v, 1e-9);
      EXPECT_NEAR(c.max_deformation / MaximumDeformation(m, v, k, n, alpha), 1, 1e-9);
      EXPECT_EQ(c.tension_time, 0);  // α ε < 1: an isolated collision never pulls.
    }
  }
}

// Glass spheres, E = 48 GPa, ν = 0.2, ρ = 2800 kg/m³, R = 10 mm, ±10 m/s: the classical numbers.
TEST(Run, AnElasticHertzImpactHasTheClassicalTimeDepthAndForce) {
  const double radius = 0.01;
  const double mass = 4.0 / 3 * std::numbers::pi * 2800 * radius * radius * radius;
  const double modulus = 48e9 / (2 * (1 - 0.2 * 0.2));
  const double stiffness = 4.0 / 3 * modulus * std::sqrt(radius / 2);
  Scenario s;
  s.bodies = {{.name = "L", .mass = mass, .radius = radius, .position = -radius, .velocity = 10},
              {.name = "R", .mass = mass, .radius = radius, .position = radius, .velocity = -10}};
  s.contacts = {{.name = "LR", .left = 0, .right = 1, .stiffness = stiffness, .restitution = 1}};
  s.end_time = 1e-4;
  const Record r = RunAndRecord(s);
  ASSERT_EQ(r.cycles.size(), 1u);
  EXPECT_NEAR(r.cycles[0].max_deformation / 274.1127e-6, 1, 1e-6);
  EXPECT_NEAR(r.cycles[0].peak_force / 10696.89, 1, 1e-6);
  EXPECT_NEAR(r.cycles[0].end_time / 40.33946e-6, 1, 1e-6);
  EXPECT_NEAR(r.outcome.velocities[0], -10, 1e-9);
}

// Fixed steps of 1 µs, one of which ends on the touch but for round-off, on either side.
TEST(Run, ATouchAtTheEndOfAStepIsACollision) {
  for (const double touch : {1e-3, 1e-3 - 1e-19, 1e-3 + 1e-19, 1e-3 + 3e-7}) {
    Scenario s = testing::Chain({0.1, 0.1}, {1e8}, {0.5}, 1, 4e-3);
    s.bodies[1].position += touch;
    s.solver.fixed_step = 1e-6;
    const Record r = RunAndRecord(s);
    ASSERT_EQ(r.outcome.end, Outcome::End::kFinished) << touch << ' ' << r.outcome.message;
    ASSERT_EQ(r.cycles.size(), 1u);
    EXPECT_EQ(r.cycles[0].kind, Cycle::Kind::kCollision);
    EXPECT_NEAR(r.cycles[0].approach_velocity, 1, 1e-12);
    EXPECT_NEAR(r.outcome.velocities[1] - r.outcome.velocities[0], 0.5, 1e-6);
  }
}

// A row of four, hit by its first ball or, mirrored, by its last. To steps so coarse what is pushed
// seems at rest for a while. A load that pulls the second pair apart keeps it from beginning at
// once.
TEST(Run, WhatTouchesACollidingBodyAtRestBeginsWithIt) {
  for (const bool mirrored : {false, true}) {
    for (const bool pulled : {false, true}) {
      Scenario s = testing::Chain({1, 1, 1, 1}, {1e8, 1e8, 1e8}, {0.8, 0.8, 0.8}, 0, 1e-2);
      if (!pulled) s.solver.relative_tolerance = 1e-4;
      s.bodies[mirrored ? 3 : 0].velocity = mirrored ? -0.2 : 0.2;
      const int third = mirrored ? 1 : 2;
      if (pulled) s.loads = {{.body = third, .end = 1e-3, .constant = mirrored ? -1.0 : 1.0}};
      const Record r = RunAndRecord(s);
      ASSERT_EQ(r.outcome.end, Outcome::End::kFinished);
      const auto first = [&r](int contact) {
        return *std::ranges::find(r.cycles, contact, &Cycle::contact);
      };
      EXPECT_EQ(first(mirrored ? 2 : 0).start_time, 0);
      EXPECT_EQ(first(1).start_time == 0, !pulled) << mirrored;
      EXPECT_EQ(first(1).kind == Cycle::Kind::kNirv, !pulled) << mirrored;
      EXPECT_EQ(first(mirrored ? 0 : 2).start_time > 0, !pulled);  // Its neighbour moves later.
    }
  }
}

// Three equal balls without damping: a classical result of the Hertz chain.
TEST(Run, AnUndampedHertzChainOfThreeEndsWithTheKnownVelocities) {
  const Record r = RunAndRecord(testing::Chain({1, 1, 1}, {1e9, 1e9}, {1, 1}, 1, 0.01));
  EXPECT_NEAR(r.outcome.velocities[0], -0.07095235, 1e-7);
  EXPECT_NEAR(r.outcome.velocities[1], 0.07640304, 1e-7);
  EXPECT_NEAR(r.outcome.velocities[2], 0.99454931, 1e-7);
}

// A constant load from rest: ε² = 1 − δ_o/δ_m in the first cycle, whatever the law.
TEST(Run, AStepLoadSatisfiesItsEnergyIdentity) {
  for (const double e : {0.3, 0.6, 0.9}) {
    Scenario s;
    s.bodies = {testing::Ball(-0.05)};
    s.contacts = {{.name = "wall", .left = 0, .stiffness = 1e8, .restitution = e}};
    s.loads = {{.body = 0, .constant = 700}};
    s.end_time = 0.01;
    const Record r = RunAndRecord(s);
    ASSERT_FALSE(r.cycles.empty());
    const Cycle& c = r.cycles[0];
    EXPECT_EQ(c.kind, Cycle::Kind::kNirv);
    EXPECT_EQ(c.status, Cycle::Status::kConverged);
    EXPECT_NEAR(c.restitution_out, e, 1e-8);
    EXPECT_NEAR(1 - c.end_deformation / c.max_deformation, e * e, 2e-8);
  }
}

// What no force acts on takes one step, however long.
TEST(Run, AFreeFlightIsOneStep) {
  Scenario s = testing::Collision(0.5, 2, 1e8, 1.5, 0.8);
  const auto steps = RunAndRecord(s).outcome.steps;
  s.end_time *= 1000;
  EXPECT_EQ(RunAndRecord(s).outcome.steps, steps);
}

// Undamped motion run backwards comes home.
TEST(Run, AnUndampedChainIsReversibleInTime) {
  Scenario s = testing::Chain({0.5, 0.9, 0.4}, {1e8, 5e7}, {1, 1}, 0.3, 3e-3);
  const Record forth = RunAndRecord(s);
  Scenario back = s;
  for (std::size_t i = 0; i < 3; ++i) {
    back.bodies[i].position = forth.outcome.positions[i];
    back.bodies[i].velocity = -forth.outcome.velocities[i];
  }
  const Record r = RunAndRecord(back);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(r.outcome.positions[i], s.bodies[i].position, 1e-11);
    EXPECT_NEAR(r.outcome.velocities[i], -s.bodies[i].velocity, 1e-8);
  }
}

// Nesterenko's solitary wave in a row of spheres that just touch: V = (2/√5) c ξ^{1/4} with the
// largest strain ξ and c² = k d^{5/2}/m, which is (2/√5) k^{1/3} m^{−1/2} F^{1/6} contacts a second
// (Nesterenko, Dynamics of Heterogeneous Materials, Springer 2001, 1.3); a long-wave formula, good
// to about 1 %. The wave keeps its peak force.
TEST(Run, ASolitaryWaveKeepsItsPeakForceAndHasTheKnownSpeed) {
  constexpr std::size_t kBalls = 30;
  Scenario s =
      testing::Chain(std::vector<double>(kBalls, 0.5), std::vector<double>(kBalls - 1, 1e8),
                     std::vector<double>(kBalls - 1, 1), 0.2, 0.02);
  for (Contact& c : s.contacts) c.damping = DampingLaw::kGiven;  // μ = 0.
  const Record r = RunAndRecord(s);
  double turn_12 = 0, turn_22 = 0, peak_12 = 0, peak_22 = 0;
  for (const Cycle& c : r.cycles) {
    if (c.number != 1) continue;
    if (c.contact == 12) turn_12 = c.turn_time, peak_12 = c.peak_force;
    if (c.contact == 22) turn_22 = c.turn_time, peak_22 = c.peak_force;
  }
  ASSERT_GT(turn_12, 0);
  EXPECT_NEAR(peak_22 / peak_12, 1, 1e-3);
  const double speed = 10 / (turn_22 - turn_12);
  const double known =
      2 / std::sqrt(5) * std::cbrt(1e8) / std::sqrt(0.5) * std::pow(peak_12, 1.0 / 6);
  EXPECT_NEAR(speed / known, 1, 0.02);
}

TEST(Run, IsTheSameToTheByteEveryTime) {
  for (Scenario s : {testing::TripleChain(), testing::SpringWall()}) {
    s.sample_interval = s.end_time / 500;
    const Record a = RunAndRecord(s), b = RunAndRecord(s);
    ASSERT_EQ(a.samples.size(), b.samples.size());
    EXPECT_EQ(std::memcmp(a.samples.data(), b.samples.data(), a.samples.size() * sizeof(double)),
              0);
    ASSERT_EQ(a.cycles.size(), b.cycles.size());
    for (std::size_t i = 0; i < a.cycles.size(); ++i) EXPECT_EQ(a.cycles[i].mu, b.cycles[i].mu);
  }
}

TEST(Run, SamplesLieOnTheTrajectoryToTheEnd) {
  Scenario s = testing::SpringWall();
  s.sample_interval = 1e-5;
  const Record r = RunAndRecord(s);
  ASSERT_EQ(r.rows(), 3501);
  EXPECT_EQ(r.columns, SampleColumns(s));
  EXPECT_EQ(r.Sample(0, 1), -0.01);
  for (int i = 0; i < r.rows(); ++i) EXPECT_NEAR(r.Sample(i, 0), i * 1e-5, 1e-14);
  EXPECT_NEAR(r.Sample(3500, 1), r.outcome.positions[0], 1e-12);
  EXPECT_NEAR(r.Sample(3500, 2), r.outcome.velocities[0], 1e-9);
  // Position and velocity belong together, and m a is the sum of forces: F_e is all but contact.
  for (int i = 1; i + 1 < r.rows(); ++i) {
    const double rate = (r.Sample(i + 1, 1) - r.Sample(i - 1, 1)) / 2e-5;
    EXPECT_NEAR(rate, r.Sample(i, 2), 2e-3) << i;
    const double t = r.Sample(i, 0), x = r.Sample(i, 1), v = r.Sample(i, 2);
    EXPECT_NEAR(r.Sample(i, 6), 500 + 250 * std::sin(2000 * t) - 1e6 * x - 100 * v, 1e-6) << i;
    EXPECT_NEAR(r.Sample(i, 3), x + 0.05 - 0.048, 1e-12) << i;
  }
}

TEST(Run, TheResultDoesNotDependOnWhatIsRecorded) {
  Scenario s = testing::SpringWall();
  const Record bare = RunAndRecord(s);
  s.sample_interval = 1e-6;
  const Record sampled = RunAndRecord(s);
  ASSERT_EQ(bare.cycles.size(), sampled.cycles.size());
  for (std::size_t i = 0; i < bare.cycles.size(); ++i) {
    EXPECT_EQ(bare.cycles[i].mu, sampled.cycles[i].mu);
    EXPECT_EQ(bare.cycles[i].end_time, sampled.cycles[i].end_time);
  }
}

TEST(Run, ABouncingBallSettlesInsteadOfCyclingForEver) {
  Scenario s;
  s.bodies = {testing::Ball(1)};
  s.contacts = {{.name = "floor", .right = 0, .stiffness = 1e8, .restitution = 0.8}};
  s.loads = {{.body = 0, .constant = -0.5 * 9.81}};
  s.end_time = 20;
  const Record r = RunAndRecord(s);
  EXPECT_EQ(r.outcome.end, Outcome::End::kFinished);
  EXPECT_LT(r.cycles.size(), 60u);
  const Cycle& rest = r.cycles.back();
  EXPECT_EQ(rest.status, Cycle::Status::kSettled);
  EXPECT_EQ(rest.end, Cycle::End::kRunEnd);
  EXPECT_NEAR(rest.end_deformation, std::pow(0.5 * 9.81 / 1e8, 2.0 / 3), 1e-12);
  EXPECT_LT(r.outcome.steps, 100'000);
  for (const Cycle& c : r.cycles) {
    if (c.status != Cycle::Status::kConverged) continue;
    EXPECT_NEAR(c.restitution_out, 0.8, 1e-8);
  }
  EXPECT_LT(r.outcome.energy_residual, 1e-9);
}

// A push wakes a resting ball; its next collision is iterated again.
TEST(Run, ARestingContactWakesWhenItsLoadGrows) {
  Scenario s;
  s.bodies = {testing::Ball(0.05)};
  s.contacts = {{.name = "floor", .right = 0, .stiffness = 1e8, .restitution = 0.5}};
  s.loads = {{.body = 0, .constant = -50, .amplitude = 60, .angular_frequency = 3, .phase = -1.5}};
  s.end_time = 4;
  s.solver.settled_fraction = s.solver.settled_nirv_fraction = 1e-4;
  const Record r = RunAndRecord(s);
  EXPECT_EQ(r.outcome.end, Outcome::End::kFinished) << r.outcome.message;
  const auto settled = std::find_if(r.cycles.begin(), r.cycles.end(), [](const Cycle& c) {
    return c.status == Cycle::Status::kSettled;
  });
  ASSERT_NE(settled, r.cycles.end());
  EXPECT_TRUE(std::any_of(settled, r.cycles.end(), [](const Cycle& c) {
    return c.kind == Cycle::Kind::kCollision && c.status == Cycle::Status::kConverged;
  }));
  EXPECT_LT(r.outcome.energy_residual, 1e-8);
}

// The end of the run cuts the trajectory, not the solution: the cut cycle has its μ.
TEST(Run, ACycleCutByTheEndHasTheSameFactorAsUncut) {
  const Record whole = RunAndRecord(testing::TripleChain());
  Scenario s = testing::TripleChain();
  s.end_time = 1e-3;
  const Record cut = RunAndRecord(s);
  ASSERT_EQ(cut.cycles.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(cut.cycles[i].mu / whole.cycles[i].mu, 1, 1e-9);
    EXPECT_EQ(cut.cycles[i].end, Cycle::End::kRunEnd);
    EXPECT_EQ(cut.cycles[i].status, Cycle::Status::kCut);
    EXPECT_EQ(cut.cycles[i].end_time, 1e-3);
  }
}

TEST(Run, StopsWhenAsked) {
  std::stop_source source;
  source.request_stop();
  Record r;
  const Outcome outcome = contact::Run(testing::TripleChain(), r, source.get_token());
  EXPECT_EQ(outcome.end, Outcome::End::kStopped);
  EXPECT_TRUE(r.cycles.empty());
}

TEST(Run, KeepsItsStepBudget) {
  Scenario s = testing::SpringWall();
  s.solver.max_steps = 500;
  const Record r = RunAndRecord(s);
  EXPECT_EQ(r.outcome.end, Outcome::End::kBudgetSteps);
  EXPECT_LE(r.outcome.steps, 510);  // A landing on an event is not cut short.
  EXPECT_FALSE(r.outcome.message.empty());
  EXPECT_GT(r.outcome.time, 0);
}

TEST(Run, TellsOnWhatItsBudgetWasSpent) {
  Scenario s = testing::TripleChain();
  s.solver.max_steps = 20;
  const std::string message = RunAndRecord(s).outcome.message;
  for (const char* part : {"in contact ", ": δ ", " m, λh ", ", work "}) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

TEST(Run, ABodyWithoutContactFlies) {
  Scenario s;
  s.bodies = {testing::Ball(1, 3)};
  s.loads = {{.body = 0, .constant = -0.5 * 9.81}};
  s.end_time = 2;
  const Record r = RunAndRecord(s);
  EXPECT_NEAR(r.outcome.positions[0], 1 + 3 * 2 - 9.81 * 2, 1e-12);
  EXPECT_NEAR(r.outcome.velocities[0], 3 - 9.81 * 2, 1e-12);
}

TEST(Run, BodiesAtRestStay) {
  Scenario s = testing::Chain({1, 1}, {1e8}, {0.5}, 0, 1);
  const Record r = RunAndRecord(s);
  EXPECT_EQ(r.outcome.end, Outcome::End::kFinished);
  EXPECT_TRUE(r.cycles.empty());
  EXPECT_EQ(r.outcome.positions[1], 0.1);
}

// Two pairs far apart: what one does must not touch the other.
TEST(Run, IndependentPairsDoNotDisturbEachOther) {
  Scenario s = testing::Chain({0.5, 0.5}, {1e8}, {0.7}, 0.3, 0.01);
  const Record alone = RunAndRecord(s);
  s.bodies.push_back(testing::Ball(10, 0.5, 0.2));
  s.bodies.push_back(testing::Ball(10.1, 0, 0.9));
  s.contacts.push_back(
      {.name = "far", .left = 2, .right = 3, .stiffness = 3e7, .restitution = 0.4});
  const Record both = RunAndRecord(s);
  ASSERT_EQ(both.cycles.size(), 2u);
  EXPECT_TRUE(both.outcome.all_converged);
  EXPECT_NEAR(both.outcome.velocities[1], alone.outcome.velocities[1], 1e-10);
}

// A scenario seen in a mirror has the mirrored solution.
TEST(Run, AMirrorChangesNothingButSigns) {
  Scenario s = testing::Chain({0.5, 0.9, 0.4}, {1e8, 5e7}, {0.8, 0.6}, 0.3, 4e-3);
  s.loads = {{.body = 1, .begin = 1e-3, .end = 2e-3, .constant = 30}};
  Scenario mirrored = s;
  for (Body& body : mirrored.bodies) body.position *= -1, body.velocity *= -1;
  for (Contact& contact : mirrored.contacts) std::swap(contact.left, contact.right);
  mirrored.loads[0].constant *= -1;
  const Record a = RunAndRecord(s), b = RunAndRecord(mirrored);
  ASSERT_EQ(a.cycles.size(), b.cycles.size());
  for (std::size_t i = 0; i < a.cycles.size(); ++i) {
    EXPECT_NEAR(b.cycles[i].mu / a.cycles[i].mu, 1, 1e-8);
    EXPECT_NEAR(b.cycles[i].work_compression / a.cycles[i].work_compression, 1, 1e-8);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(b.outcome.velocities[i], -a.outcome.velocities[i], 1e-9);
  }
}

TEST(Run, AUniformMotionOfAllChangesNothingElse) {
  Scenario s = testing::Chain({0.5, 0.9, 0.4}, {1e8, 5e7}, {0.8, 0.6}, 0.3, 4e-3);
  const Record rest = RunAndRecord(s);
  for (Body& body : s.bodies) body.velocity += 0.5;
  const Record moving = RunAndRecord(s);
  ASSERT_EQ(rest.cycles.size(), moving.cycles.size());
  for (std::size_t i = 0; i < rest.cycles.size(); ++i) {
    EXPECT_NEAR(moving.cycles[i].mu / rest.cycles[i].mu, 1, 1e-6);
    EXPECT_NEAR(moving.cycles[i].end_time / rest.cycles[i].end_time, 1, 1e-7);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(moving.outcome.velocities[i] - 0.5, rest.outcome.velocities[i], 1e-8);
  }
}

// Masses, stiffnesses and loads in other units of mass: the same motion, and works in these units.
TEST(Run, UnitsOfMassDoNotMatter) {
  Scenario s = testing::SpringWall();
  const Record kilograms = RunAndRecord(s);
  constexpr double kUnit = 1024;
  for (Body& body : s.bodies) body.mass *= kUnit;
  for (Contact& contact : s.contacts) contact.stiffness *= kUnit;
  for (Support& support : s.supports) support.stiffness *= kUnit, support.damping *= kUnit;
  for (Load& load : s.loads) load.constant *= kUnit, load.amplitude *= kUnit;
  const Record other = RunAndRecord(s);
  ASSERT_EQ(kilograms.cycles.size(), other.cycles.size());
  for (std::size_t i = 0; i < other.cycles.size(); ++i) {
    const Cycle &a = kilograms.cycles[i], &b = other.cycles[i];
    EXPECT_NEAR(b.mu / a.mu, kUnit, 1e-6 * kUnit);
    if (a.status != Cycle::Status::kCut) {
      EXPECT_NEAR(b.work_compression / a.work_compression, kUnit, 1e-6 * kUnit);
    }
    EXPECT_NEAR(b.end_time, a.end_time, 1e-9);
  }
  EXPECT_NEAR(other.outcome.positions[0], kilograms.outcome.positions[0], 1e-9);
}

TEST(Run, LedgerIsInTheOrderOfEndTimes) {
  const Record r =
      RunAndRecord(testing::Chain(std::vector<double>(8, 0.5), std::vector<double>(7, 1e8),
                                  std::vector<double>(7, 0.8), 0.2, 0.01));
  ASSERT_GE(r.cycles.size(), 7u);
  EXPECT_TRUE(std::ranges::is_sorted(r.cycles, {}, &Cycle::end_time));
}

TEST(Run, ThatMustConvergeEndsAtTheFirstCycleThatDoesNot) {
  Scenario s = testing::SpringWall();
  s.solver.max_iterations = 1;
  s.solver.restitution_tolerance = 1e-14;
  const Record tolerant = RunAndRecord(s);
  ASSERT_FALSE(tolerant.outcome.all_converged);
  EXPECT_EQ(tolerant.outcome.end, Outcome::End::kFinished);
  s.solver.fail_if_not_converged = true;
  const Record strict = RunAndRecord(s);
  EXPECT_EQ(strict.outcome.end, Outcome::End::kNotConverged);
  EXPECT_LT(strict.cycles.size(), tolerant.cycles.size());
  EXPECT_NE(strict.outcome.message.find("contact wall, cycle"), std::string::npos)
      << strict.outcome.message;
}

TEST(Run, AnExceptionOfTheObserverLeavesIt) {
  struct Full : Observer {
    void OnCycle(const Cycle& /*cycle*/) override { throw std::runtime_error("disk full"); }
  } observer;
  EXPECT_THROW(contact::Run(testing::TripleChain(), observer), std::runtime_error);
}

}  // namespace
}  // namespace contact
