// Bodies solved in parts move as all together do, and cost what moves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <random>
#include <stop_token>
#include <string>
#include <vector>

#include "simulation/clusters/both_ways.h"
#include "simulation/model/derived.h"
#include "testing/cases.h"

namespace contact {
namespace {

using testing::Column;
using testing::ExpectClosedBalances;
using testing::ExpectSame;
using testing::Gas;
using testing::Record;
using testing::RunAndRecord;
using testing::RunTogether;

// Random scenarios of a kind; an unoptimized build solves one.
constexpr unsigned kSeeds = testing::kOptimized ? 4 : 1;

TEST(Clusters, AGasMovesAsAllTogetherDo) {
  for (const double stiffness : {1e6, 1e9}) {
    for (unsigned seed = 1; seed <= kSeeds; ++seed) {
      const Scenario s = Gas(40, stiffness, seed);
      const Record parts = RunAndRecord(s), whole = RunTogether(s);
      ExpectSame(parts, whole, 1e-9, 1e-6);  // With ξ = 1e-8.
      ExpectClosedBalances(parts.outcome);
      EXPECT_TRUE(parts.outcome.all_converged);
    }
  }
}

// Where collisions hardly ever are alone: parts meet while both run, and become one.
TEST(Clusters, ADenseGasMovesAsAllTogetherDo) {
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const Scenario s = Gas(30, 1e9, seed, 0.1);
    const Record parts = RunAndRecord(s), whole = RunTogether(s);
    ExpectSame(parts, whole, 1e-7, 1e-4);  // Differences grow from collision to collision.
    ExpectClosedBalances(parts.outcome);
  }
}

// Of any stiffness, restitution and density, with masses over a decade, falling or not, with balls
// at rest or fixed among them.
Scenario RandomGas(unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  const auto one_in = [&](unsigned count) { return random() % count == 0; };
  const int balls = 8 + static_cast<int>(random() % 33);
  const double stiffness = std::pow(10, between(6, 9));
  Scenario s = Gas(balls, stiffness, seed, std::pow(10, between(-1.1, 0)));
  const double restitution = between(0.3, 0.95);
  for (Contact& contact : s.contacts) contact.restitution = restitution * between(0.9, 1.05);
  const double gravity = one_in(3) ? between(-10, 10) : 0;
  for (int i = 0; i < balls; ++i) {
    Body& ball = s.bodies[static_cast<std::size_t>(i)];
    ball.mass *= std::pow(10, between(-0.5, 0.5));
    ball.fixed = one_in(40);
    if (ball.fixed || one_in(6)) ball.velocity = 0;
    if (gravity != 0) s.loads.push_back({.body = i, .constant = gravity * ball.mass});
  }
  s.solver.max_steps = 400'000;
  return s;
}

// The same cycles but in a few: where a tail is chaotic, and where two sets of μ solve the same
// groups.
TEST(Clusters, RandomGasesKeepTheirBalancesAndTheirCycles) {
  if (!testing::kOptimized) GTEST_SKIP() << "takes minutes";
  const testing::Both both = testing::RunBothWays(RandomGas, 40, 1e-9);
  EXPECT_GE(both.finished, 30);
  EXPECT_GE(both.same, both.finished - 3);
}

// A fixed ball hangs in the air, whatever pulls at it.
TEST(Clusters, WhatIsFixedDoesNotFall) {
  Scenario s = Column(9, 1e7, 0.5, 0.001);
  s.bodies[4].fixed = true;
  s.end_time = 0.028;
  const Record parts = RunAndRecord(s), whole = RunTogether(s);
  ExpectSame(parts, whole, 1e-7, 1e-4);  // Differences grow from bounce to bounce.
  ExpectClosedBalances(parts.outcome);
  EXPECT_EQ(parts.outcome.positions[4], s.bodies[4].position);
}

TEST(Clusters, SamplesAreThoseOfAllTogether) {
  Scenario s = Gas(20, 1e6, 2);
  s.sample_interval = s.end_time / 300;
  const Record parts = RunAndRecord(s), whole = RunTogether(s);
  ASSERT_EQ(parts.rows(), 301);
  ASSERT_EQ(whole.rows(), 301);
  const int forces = static_cast<int>(1 + 2 * s.bodies.size());
  const int rest = forces + 4 * static_cast<int>(s.contacts.size());
  for (int row = 0; row < 301; ++row) {
    for (int column = 0; column < parts.columns; ++column) {
      const bool is_force = column >= forces && column < rest && (column - forces) % 4 >= 2;
      const bool is_acceleration = column >= rest && column < rest + std::ssize(s.bodies);
      ASSERT_NEAR(parts.Sample(row, column), whole.Sample(row, column),
                  is_acceleration ? 1e-3
                  : is_force      ? 1e-5
                                  : 1e-8)
          << row << " " << column;
    }
  }
}

// Every second contact goes back on another way, a part of them more steeply after hard blows.
TEST(Clusters, TablesThatYieldAreThoseOfAllTogether) {
  Scenario s = Gas(20, 1e6, 2);
  for (std::size_t c = 0; c < s.contacts.size(); c += 2) {
    Contact& contact = s.contacts[c];
    contact.damping = DampingLaw::kForceTable;
    contact.table = ForceTable({{2e-5, 1}, {2e-4, 20}}, {1.5e5, c % 4 == 0 ? 500.0 : 0.0});
    contact.stiffness = 1e5, contact.exponent = 1;
  }
  s.sample_interval = s.end_time / 3000;
  const Record parts = RunAndRecord(s), whole = RunTogether(s);
  ExpectSame(parts, whole, 1e-9, 1e-5);
  ExpectClosedBalances(parts.outcome);
  ASSERT_EQ(parts.rows(), whole.rows());
  const int energies = parts.columns - 5;
  for (int row = 0; row < parts.rows(); ++row) {
    for (int column = energies; column < parts.columns; ++column) {
      ASSERT_NEAR(parts.Sample(row, column), whole.Sample(row, column), 1e-10)
          << row << " " << column;
    }
  }
}

TEST(Clusters, SamplesWithinACollisionAreAsManyAsAsked) {
  Scenario s = Gas(8, 1e8, 3);
  s.sample_interval = s.end_time;
  s.samples_per_contact = 20;
  const Record parts = RunAndRecord(s), whole = RunTogether(s);
  EXPECT_NEAR(parts.rows(), whole.rows(), 2);
  for (int row = 1; row < parts.rows(); ++row) {
    ASSERT_GT(parts.Sample(row, 0), parts.Sample(row - 1, 0));
  }
}

TEST(Clusters, SamplesWithinCollisionsEndAtTheirMostAndThatIsSaid) {
  Scenario s = Gas(8, 1e8, 3);
  s.sample_interval = s.end_time;
  s.samples_per_contact = 20;
  s.most_contact_samples = 15;
  const Record parts = RunAndRecord(s), whole = RunTogether(s);
  EXPECT_EQ(parts.rows(), 2 + 15);
  EXPECT_EQ(parts.warnings, whole.warnings);
  EXPECT_EQ(parts.warnings.size(), 1U);
}

// After how many steps passes were told.
struct Live : Observer {
  std::int64_t steps = 0;
  std::vector<std::int64_t> passes;
  void OnStep() override { ++steps; }
  void OnIteration(const Iteration& /*iteration*/) override { passes.push_back(steps); }
};

TEST(Clusters, PassesAreToldAsTheyAreMade) {
  const Scenario row = testing::Chain(std::vector<double>(20, 0.5), std::vector<double>(19, 1e8),
                                      std::vector<double>(19, 0.9), 0.2, 1e-3);
  for (const Scenario& scenario : {row, Gas(30, 1e9, 1, 0.1)}) {
    Live live;
    const Outcome outcome = contact::Run(scenario, live);
    ASSERT_EQ(outcome.end, Outcome::End::kFinished);
    const std::size_t count = live.passes.size();
    ASSERT_GE(count, 8U);
    EXPECT_GE(std::ssize(live.passes), outcome.iterations);
    for (std::size_t i = 1; i < 4; ++i) {
      EXPECT_GT(live.passes[i * count / 4], live.passes[(i - 1) * count / 4]);
    }
  }
}

Scenario TouchingRow(int balls) {
  const auto contacts = static_cast<std::size_t>(balls) - 1;
  return testing::Chain(std::vector<double>(contacts + 1, 0.5), std::vector<double>(contacts, 1e8),
                        std::vector<double>(contacts, 0.9), 1, 2e-3);
}

TEST(Clusters, ARowOfTouchingBallsMovesAsAllTogetherDo) {
  const Scenario row = TouchingRow(30);
  const Record parts = RunAndRecord(row);
  ExpectSame(parts, RunTogether(row), 1e-9, 1e-6);
  ExpectClosedBalances(parts.outcome);
}

// Balls that lie beside what moves are met when they are pressed.
TEST(Clusters, APulseInARowCostsWhatItHasReached) {
  const auto seconds = [](int balls) {
    const Scenario row = TouchingRow(balls);
    double least = 1e9;
    for (int i = 0; i < 3; ++i) {
      const std::clock_t begin = std::clock();
      RunAndRecord(row);
      least = std::min(least, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    }
    return least;
  };
  EXPECT_LT(seconds(3000), 8 * seconds(30));  // 70 times, if all were solved together.
}

TEST(Clusters, RowsAreToldInTheOrderOfTheirEnds) {
  const Record r = RunAndRecord(Gas(200, 1e6, 5));
  EXPECT_GT(r.cycles.size(), 100U);
  EXPECT_TRUE(std::ranges::is_sorted(r.cycles, {}, &Cycle::end_time));
}

// A search for μ in one place has nothing to do with those elsewhere.
TEST(Clusters, ACollisionCostsTheSameInALargerGas) {
  const auto steps_per_cycle = [](int balls) {
    const Record r = RunAndRecord(Gas(balls, 1e9, 7));
    return static_cast<double>(r.outcome.steps) / static_cast<double>(r.cycles.size());
  };
  const double few = steps_per_cycle(100);
  EXPECT_LT(few, 60);
  EXPECT_NEAR(steps_per_cycle(testing::kOptimized ? 2000 : 300) / few, 1, 0.15);
}

// Two rows that the same ball hits at once, from both sides.
TEST(Clusters, TiesAreOneCluster) {
  Scenario s = testing::Chain(std::vector<double>(9, 0.5), std::vector<double>(8, 1e8),
                              std::vector<double>(8, 0.9), 0, 0.01);
  for (int i : {0, 8}) {
    Body& ball = s.bodies[static_cast<std::size_t>(i)];
    ball.position += i == 0 ? -0.015625 : 0.015625;
    ball.velocity = i == 0 ? 10 : -10;
  }
  const Record r = RunAndRecord(s);
  ExpectClosedBalances(r.outcome);
  for (int i = 0; i < 9; ++i) {  // The mirror image of itself.
    EXPECT_NEAR(r.outcome.velocities[static_cast<std::size_t>(i)],
                -r.outcome.velocities[static_cast<std::size_t>(8 - i)], 1e-9);
  }
}

// Each on a floor of its own, until all rest: δ of k δ^1.5 = m g.
TEST(Clusters, BallsThatFallComeToRest) {
  Scenario s = Column(8, 1e7, 0.3, 0.001);
  for (Contact& contact : s.contacts) {
    const Body& ball = s.bodies[static_cast<std::size_t>(contact.left)];
    contact.right = kNone;
    contact.wall_position = ball.position + 0.012;
  }
  ASSERT_TRUE(MayPart(s));
  const Record r = RunAndRecord(s);
  ExpectClosedBalances(r.outcome);
  EXPECT_TRUE(r.outcome.all_converged);
  const double depth = std::pow(0.03 * 9.81 / 1e7, 2.0 / 3);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(r.outcome.positions[i] - s.bodies[i].position - 0.002, depth, 1e-2 * depth);
  }
}

// A ball at rest on a wall, a gas, and a ball that reaches the first one late.
TEST(Clusters, WhatRestsIsStruckWhereItRests) {
  Scenario s = Gas(8, 1e8, 9);
  s.end_time = 0.4;
  s.contacts[0].wall_position = -0.5;
  s.bodies[0].position = -0.49;
  s.bodies[0].velocity = 0;
  s.loads = {{.body = 0, .constant = -3}};  // It presses on the wall.
  s.bodies[1].velocity = -1.5;
  const Record parts = RunAndRecord(s), whole = RunTogether(s);
  ExpectClosedBalances(parts.outcome);
  ASSERT_EQ(parts.cycles.size(), whole.cycles.size());
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    EXPECT_NEAR(parts.outcome.velocities[i], whole.outcome.velocities[i], 1e-6);
  }
}

// All parts percolate: what is solved for nothing is bounded.
TEST(Clusters, ARowThatIsOneClusterCostsLittleMoreThanTogether) {
  if (!testing::kOptimized) GTEST_SKIP() << "takes minutes";
  const Scenario s = Gas(20, 1e6, 1, 0.1);
  const Record parts = RunAndRecord(s), whole = RunTogether(s);
  ExpectClosedBalances(parts.outcome);
  EXPECT_LT(static_cast<double>(parts.outcome.steps), 3 * static_cast<double>(whole.outcome.steps));
}

TEST(Clusters, TheBudgetOfStepsEndsTheRunWithWhatIsCertain) {
  Scenario s = Gas(100, 1e6, 1);
  const Record whole = RunAndRecord(s);
  s.solver.max_steps = whole.outcome.steps / 2;
  const Record half = RunAndRecord(s);
  EXPECT_EQ(half.outcome.end, Outcome::End::kBudgetSteps);
  EXPECT_LE(half.outcome.steps, s.solver.max_steps);
  EXPECT_LT(half.outcome.time, s.end_time);
  ASSERT_LT(half.cycles.size(), whole.cycles.size());
  EXPECT_GT(half.cycles.size(), 0U);
  for (std::size_t i = 0; i < half.cycles.size(); ++i) {
    EXPECT_EQ(half.cycles[i].contact, whole.cycles[i].contact);
    EXPECT_EQ(half.cycles[i].mu, whole.cycles[i].mu);
  }
}

TEST(Clusters, ARunThatIsStoppedSaysSo) {
  std::stop_source source;
  struct Stopper : Record {
    std::stop_source* source = nullptr;
    void OnCycle(const Cycle& c) override {
      Record::OnCycle(c);
      if (cycles.size() == 10) source->request_stop();
    }
  } stopper;
  stopper.source = &source;
  const Outcome outcome = contact::Run(Gas(1000, 1e9, 1), stopper, source.get_token());
  EXPECT_EQ(outcome.end, Outcome::End::kStopped);
  EXPECT_GE(stopper.cycles.size(), 10U);
  EXPECT_LT(outcome.time, 0.05);
}

TEST(Clusters, AFewBodiesAndSpringsThatSlipAreSolvedTogether) {
  Scenario s = Gas(20, 1e6, 1);
  EXPECT_TRUE(MayPart(s));
  s.supports = {{.body = 0, .stiffness = 1e3}};
  EXPECT_TRUE(MayPart(s));
  s.supports[0].slip_force = 1;
  EXPECT_FALSE(MayPart(s));
  EXPECT_FALSE(MayPart(Gas(4, 1e6, 1)));
}

TEST(Clusters, BodiesThatStayInTouchAreSolvedTogether) {
  Scenario s = TouchingRow(20);
  EXPECT_TRUE(MayPart(s));
  s.loads = {{.body = 0, .constant = 1}};
  EXPECT_TRUE(MayPart(s));
  s.loads[0].begin = 1e-3;
  EXPECT_FALSE(MayPart(s));
}

}  // namespace
}  // namespace contact
