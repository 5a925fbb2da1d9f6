// Contacts that are pressed when the run begins.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "simulation/laws/isolated_collision.h"
#include "simulation/proof/independent.h"
#include "simulation/statics/equilibrium.h"
#include "testing/cases.h"

namespace contact {
namespace {

using testing::Record;
using testing::RunAndRecord;

constexpr double kPi = 3.14159265358979323846;

// Two balls of 1 mm between two walls, all three contacts linear and pressed by 0.05 to 0.1 mm.
Scenario PressedPair() {
  Scenario s;
  const double radius = 0.5e-3, volume = 4 * kPi / 3 * std::pow(radius, 3);
  s.bodies = {
      {.name = "low", .mass = 2e4 * volume, .radius = radius, .position = 0.45e-3},
      {.name = "high", .mass = 1e4 * volume, .radius = radius, .position = 1.35e-3},
  };
  s.contacts = {
      {.name = "floor", .right = 0, .stiffness = 1e3, .exponent = 1},
      {.name = "pair", .left = 0, .right = 1, .stiffness = 1e3, .exponent = 1},
      {.name = "lid", .left = 1, .wall_position = 1.8e-3, .stiffness = 1e3, .exponent = 1},
  };
  for (int i = 0; i < 2; ++i) {
    s.loads.push_back(
        {.body = i, .constant = -9.80665 * s.bodies[static_cast<std::size_t>(i)].mass});
  }
  s.end_time = 1e-3;
  return s;
}

// A ball on a floor, pressed by `depth` [m], of which nothing else holds it.
Scenario PressedBall(double depth, double velocity, double restitution, double exponent = 1.5) {
  Scenario s;
  s.bodies = {testing::Ball(0.05 - depth, velocity, 1)};
  s.contacts = {{.name = "floor",
                 .right = 0,
                 .stiffness = 1e7,
                 .exponent = exponent,
                 .restitution = restitution}};
  s.end_time = 1;
  return s;
}

// M ü + K u = f with K of three springs: u = u_e + Σ_j φ_j cos(ω_j t) (φ_j·M (u₀ − u_e)).
TEST(StartPressed, LinearContactsMoveAsTheirModesDo) {
  const Scenario s = PressedPair();
  const Record r = RunAndRecord(s);
  const Eigen::Vector2d masses(s.bodies[0].mass, s.bodies[1].mass);
  const Eigen::Matrix2d m = masses.asDiagonal();
  const Eigen::Matrix2d k = 1e3 * (Eigen::Matrix2d() << 2, -1, -1, 2).finished();
  // Without deformation the balls would stand at 0.5 and 1.3 mm, the pair 1 mm apart.
  const Eigen::Vector2d slack(1e3 * (0.5e-3 - 1e-3), 1e3 * (1e-3 + 1.3e-3));
  const Eigen::Vector2d rest = k.inverse() * (slack - 9.80665 * masses);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> modes(k, m);
  const Eigen::Vector2d start(s.bodies[0].position, s.bodies[1].position);
  const Eigen::Vector2d amplitudes = modes.eigenvectors().transpose() * m * (start - rest);
  const Eigen::Vector2d omega = modes.eigenvalues().cwiseSqrt();
  const Eigen::Vector2d swung =
      amplitudes.cwiseProduct((omega * s.end_time).array().cos().matrix());
  const Eigen::Vector2d sped =
      -amplitudes.cwiseProduct(omega).cwiseProduct((omega * s.end_time).array().sin().matrix());
  const Eigen::Vector2d x = rest + modes.eigenvectors() * swung;
  const Eigen::Vector2d v = modes.eigenvectors() * sped;
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(r.outcome.positions[static_cast<std::size_t>(i)], x[i], 1e-12);
    EXPECT_NEAR(r.outcome.velocities[static_cast<std::size_t>(i)], v[i], 1e-9);
  }
  // As published for this case, a verification of MFIX.
  EXPECT_NEAR(r.outcome.positions[0], 0.42713e-3, 5e-9);
  EXPECT_NEAR(r.outcome.positions[1], 1.38355e-3, 5e-9);
  EXPECT_NEAR(r.outcome.velocities[1], 0.39185, 5e-6);
  EXPECT_TRUE(r.outcome.all_converged);
  EXPECT_LT(r.outcome.energy_residual, 1e-11);
}

TEST(StartPressed, AllThatAnElasticContactHoldsBecomesMotion) {
  for (const double exponent : {1.0, 1.5, 3.0}) {
    const Record r = RunAndRecord(PressedBall(0.01, 0, 1, exponent));
    const double stored = ElasticEnergy(1e7, exponent, 0.01);
    EXPECT_NEAR(0.5 * std::pow(r.outcome.velocities[0], 2) / stored, 1, 1e-10) << exponent;
    EXPECT_LT(r.outcome.energy_residual, 1e-10) << exponent;
  }
}

// Begun anew at instants of its compression and of its restitution.
TEST(StartPressed, ACollisionBegunInItsMiddleEndsAsItWouldHave) {
  for (const double exponent : {1.0, 1.5, 3.0}) {
    for (const double restitution : {0.2, 0.7, 1.0}) {
      Scenario whole = PressedBall(0, -2, restitution, exponent);
      const Record all = RunAndRecord(whole);
      ASSERT_EQ(all.cycles.size(), 1U);
      whole.contacts[0].damping = DampingLaw::kGiven;
      whole.contacts[0].mu = all.cycles[0].mu;
      for (const double part : {0.2, 0.6, 1.3, 1.8}) {
        const double turn = all.cycles[0].turn_time, end = all.cycles[0].end_time;
        whole.end_time = part < 1 ? part * turn : turn + (part - 1) * (end - turn);
        const Record begun = RunAndRecord(whole);
        Scenario rest = PressedBall(0, begun.outcome.velocities[0], restitution, exponent);
        rest.bodies[0].position = begun.outcome.positions[0];
        const Record r = RunAndRecord(rest);
        EXPECT_NEAR(r.outcome.velocities[0] / all.outcome.velocities[0], 1, 1e-8)
            << exponent << " " << restitution << " " << part;
        ASSERT_EQ(r.cycles.size(), 1U);
        EXPECT_EQ(r.cycles[0].status, Cycle::Status::kReleased);
        EXPECT_NEAR(r.cycles[0].mu, all.cycles[0].mu, 1e-7 * all.cycles[0].mu);
      }
    }
  }
}

// r = ε² α²/(2 (α − ln(1 + α))) of what is stored.
TEST(StartPressed, WhatIsLetGoGivesBackWhatItsCollisionWouldHave) {
  for (const double e : {0.3, 0.5, 0.9}) {
    const Record r = RunAndRecord(PressedBall(0.01, 0, e));
    const double alpha = ExactCoefficient(e);
    const double part = e * e * alpha * alpha / (2 * (alpha - std::log1p(alpha)));
    ASSERT_EQ(r.cycles.size(), 1U);
    EXPECT_EQ(r.cycles[0].status, Cycle::Status::kReleased);
    EXPECT_NEAR(-r.cycles[0].work_restitution / ElasticEnergy(1e7, 1.5, 0.01), part, 1e-9) << e;
  }
}

TEST(StartPressed, TheFirstSampleTellsTheForce) {
  Scenario s = PressedBall(0.01, 0, 0.5);
  s.sample_interval = 1e-3;
  const Record r = RunAndRecord(s);
  ASSERT_GT(r.rows(), 0);
  EXPECT_EQ(r.Sample(0, 0), 0);
  EXPECT_DOUBLE_EQ(r.Sample(0, 3), 0.01);
  EXPECT_DOUBLE_EQ(r.Sample(0, 5), 1e7 * std::pow(0.01, 1.5));
}

TEST(StartPressed, ANamedLawHasTheMuOfTheCollisionToo) {
  Scenario s = PressedBall(0.01, 0, 0.5);
  s.contacts[0].damping = DampingLaw::kHuntCrossley;
  const Record r = RunAndRecord(s);
  const double alpha = 0.75;
  const double speed = ApproachVelocity(1, 0.01, 0, 1e7, 1.5, alpha);
  EXPECT_NEAR(r.cycles[0].mu / (alpha * 1e7 / speed), 1, 1e-12);
}

// What presses it is what holds it: nothing moves, and nothing is lost.
TEST(StartAtRest, ABallOnItsFloorStays) {
  Scenario s = PressedBall(std::pow(10 / 1e7, 1 / 1.5), 0, 0.5);
  s.loads = {{.body = 0, .constant = -10}};
  s.starts_at_rest = true;
  s.end_time = 1;
  const Record r = RunAndRecord(s);
  ASSERT_EQ(r.cycles.size(), 1U);
  EXPECT_EQ(r.cycles[0].status, Cycle::Status::kSettled);
  EXPECT_LT(std::abs(r.outcome.velocities[0]), 1e-15);
  EXPECT_LT(r.outcome.steps, 1000);
}

TEST(StartAtRest, ARestThatALoadEndsIsARelease) {
  Scenario s = PressedBall(1e-4, 0, 0.5);
  s.loads = {{.body = 0, .constant = -10}, {.body = 0, .begin = 0.5, .constant = 10}};
  s.starts_at_rest = true;
  s.end_time = 1;
  const Record r = RunAndRecord(s);
  ASSERT_EQ(r.cycles.size(), 2U);
  EXPECT_EQ(r.cycles[0].status, Cycle::Status::kSettled);
  EXPECT_EQ(r.cycles[1].status, Cycle::Status::kReleased);
  EXPECT_EQ(r.cycles[1].start_time, 0.5);
  const double alpha = ExactCoefficient(0.5);
  const double part = 0.25 * alpha * alpha / (2 * (alpha - std::log1p(alpha)));
  EXPECT_NEAR(-r.cycles[1].work_restitution / ElasticEnergy(1e7, 1.5, 1e-4), part, 1e-6);
}

TEST(StartAtRest, ABlowAtTheStartEndsARest) {
  Scenario s = PressedBall(1e-4, 0, 0.5);
  s.bodies.push_back(testing::Ball(0.15 - 1e-4, -1, 0.1));
  s.contacts.push_back(
      {.name = "blow", .left = 0, .right = 1, .stiffness = 1e7, .restitution = 0.8});
  s.loads = {{.body = 0, .constant = -10}};
  s.starts_at_rest = true;
  s.end_time = 5e-3;
  const Record r = RunAndRecord(s);
  const auto struck = std::ranges::find(r.cycles, 0, &Cycle::contact);
  ASSERT_NE(struck, r.cycles.end());
  EXPECT_EQ(struck->start_time, 0);
  EXPECT_GT(struck->max_deformation, 2e-4);
  EXPECT_LT(r.outcome.energy_residual, 1e-10);
}

// The first peak of a small pulse in a row of Hertz contacts, k = m = D = 1, pressed by F₀ = 1: it
// runs at 1.2149 contacts a unit of time between balls 60 and 140, by another program; without
// dispersion it would at √1.5 = 1.2247.
// A pulse pushes the low ball of a pressed pair up. It leaves the floor, and presses the pair,
// which the lid holds: what presses a contact is no less where the lid's cycle begins a moment
// later.
TEST(StartAtRest, OnlyWhatAPulseLetsGoIsReleased) {
  Scenario s;
  s.bodies = {testing::Ball(0.05 - 1e-6), testing::Ball(0.15 - 2e-6)};
  s.contacts = {{.name = "floor", .right = 0, .stiffness = 1e7, .restitution = 0.8},
                {.name = "pair", .left = 0, .right = 1, .stiffness = 1e7, .restitution = 0.8},
                {.name = "lid",
                 .left = 1,
                 .wall_position = 0.2 - 3e-6,
                 .stiffness = 1e7,
                 .restitution = 0.8}};
  const double pulse = 3e-4;
  s.loads = {{.body = 0,
              .begin = 1e-3,
              .end = 1e-3 + pulse,
              .amplitude = 200,
              .angular_frequency = kPi / pulse}};
  s.starts_at_rest = true;
  s.end_time = 3e-3;
  const Record r = RunAndRecord(s);
  EXPECT_TRUE(r.outcome.all_converged);
  std::vector<double> resting(3);
  for (const Cycle& cycle : r.cycles) {
    double& rest = resting[static_cast<std::size_t>(cycle.contact)];
    if (cycle.number == 1) rest = cycle.mu;  // With which a release goes on.
    const bool released = cycle.number == 2 && cycle.mu > 0.9 * rest;
    EXPECT_EQ(released, cycle.number == 2 && cycle.contact == 0) << cycle.contact;
  }
}

TEST(StartAtRest, APulseInAPressedRowRunsAsFastAsPublished) {
  if (!testing::kOptimized) GTEST_SKIP();
  Scenario s;
  constexpr int kBalls = 200;
  for (int i = 0; i < kBalls; ++i) {
    s.bodies.push_back({.name = std::to_string(i), .mass = 1, .radius = 1, .position = 1.0 * i});
    if (i > 0) {
      s.contacts.push_back({.name = std::to_string(i), .left = i - 1, .right = i, .stiffness = 1});
    }
  }
  s.loads = {{.body = 0, .constant = 1},
             {.body = kBalls - 1, .constant = -1},
             {.body = 0, .begin = 0, .end = 0.5, .constant = 1e-3}};
  s.starts_at_rest = true;
  s.solver.relative_tolerance = 1e-9;
  s.end_time = 140;
  s.sample_interval = 0.02;
  const Record r = RunAndRecord(s);
  const auto peak = [&](int ball) {  // When it is fastest for the first time, by a parabola.
    const int column = 2 + 2 * ball;
    const auto at = [&](int row) { return r.Sample(row, column); };
    int row = 1;
    while (at(row) < 2e-5 || at(row + 1) > at(row)) ++row;
    const double rise = at(row) - at(row - 1), fall = at(row) - at(row + 1);
    return 0.02 * (row + 0.5 * (rise - fall) / (rise + fall));
  };
  EXPECT_NEAR(80 / (peak(140) - peak(60)), 1.2149, 5e-4);
}

// A pile that begins pressed in places, or one that stands and is struck.
class Piles {
 public:
  Scenario Roll(bool stands) {
    Scenario s;
    const int balls = 1 + static_cast<int>(Uniform(0, 5));
    double top = 0;
    for (int b = 0; b < balls; ++b) {
      if (!stands) top -= Log(1e-6, 1e-3);
      s.bodies.push_back(testing::Ball(top + 0.05, 0, Log(0.03, 3)));
      top += 0.1;
      if (!stands && Uniform(0, 1) < 0.3) s.bodies.back().velocity = Uniform(-1, 1);
      if (stands || Uniform(0, 1) < 0.5) {
        s.loads.push_back({.body = b, .constant = -9.81 * s.bodies.back().mass});
      }
      s.contacts.push_back(Law(b - 1, b));
    }
    if (stands) {
      const Equilibrium found = FindEquilibrium(s);
      for (std::size_t b = 0; b < s.bodies.size(); ++b) s.bodies[b].position = found.positions[b];
      s.starts_at_rest = true;
      const double height = top + 0.05 + Log(1e-6, 1e-3);
      s.bodies.push_back(testing::Ball(height, -Log(0.05, 2), Log(0.03, 3)));
      s.contacts.push_back(Law(balls - 1, balls));
    }
    s.end_time = Uniform(0.002, 0.03);
    s.solver.max_steps = 3'000'000;
    return s;
  }

 private:
  double Uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_()) / 4294967296.0);
  }
  double Log(double low, double high) { return low * std::pow(high / low, Uniform(0, 1)); }
  Contact Law(int left, int right) {
    return {.name = std::to_string(right),
            .left = left,
            .right = right,
            .stiffness = Log(1e6, 3e8),
            .exponent = Uniform(0, 1) < 0.7 ? 1.5 : Uniform(1, 3),
            .restitution = Uniform(0.3, 1)};
  }

  std::mt19937 random_{1};  // Its numbers are those of the standard, everywhere.
};

TEST(Start, OfRandomPilesIsConfirmedByAnIndependentIntegration) {
  Piles piles;
  int full = 0;
  const int runs = testing::kOptimized ? 60 : 8;
  for (int i = 0; i < runs; ++i) {
    const Scenario s = piles.Roll(i % 2 == 1);
    const Record r = RunAndRecord(s);
    EXPECT_EQ(r.outcome.end, Outcome::End::kFinished) << i;
    EXPECT_LT(r.outcome.energy_residual, 1e-10) << i;
    full += r.outcome.all_converged;
    const testing::Disagreement miss = testing::CompareWithIndependent(s, r);
    EXPECT_LT(miss.worst, 1e-8) << i << " " << miss.where;
    EXPECT_EQ(miss.checked_until, s.end_time) << i;
  }
  EXPECT_GE(full, runs - 1);
}

}  // namespace
}  // namespace contact
