// Rows and columns of six to thirty balls, and a ball that rattles: every group has its answer, in
// few steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "simulation/kinds.h"
#include "simulation/kinds/catalogue.h"
#include "testing/cases.h"

namespace contact {
namespace {

using testing::Kind;
using testing::Record;
using testing::RunAndRecord;

// A seed of kinds.h, and the most steps that its search may take.
struct LongRowCase {
  Kind kind;
  unsigned seed;
  std::int64_t steps;
};

std::string LongRowName(const ::testing::TestParamInfo<LongRowCase>& info) {
  return testing::kKindNames[static_cast<int>(info.param.kind)] + std::to_string(info.param.seed);
}

Record RunOf(const LongRowCase& of) {
  Scenario scenario = testing::Dice(of.seed, of.kind).Roll();
  scenario.solver.max_steps = of.steps;
  return RunAndRecord(scenario);
}

// A run that spends its steps has no group that misses, for it has told none.
bool IsSolved(const Record& r) {
  return r.outcome.end == Outcome::End::kFinished && r.outcome.all_converged;
}

class LongRow : public ::testing::TestWithParam<LongRowCase> {};

// Bisection of whole fronts, and of groups with a μ that nothing feels, took 11 and 3.9 million
// steps.
TEST_P(LongRow, IsFullInFewSteps) {
  if (!testing::kOptimized) GTEST_SKIP() << "takes minutes in this build";
  const Record r = RunOf(GetParam());
  ASSERT_EQ(r.outcome.end, Outcome::End::kFinished) << r.outcome.message;
  EXPECT_TRUE(r.outcome.all_converged);
  EXPECT_LT(r.outcome.energy_residual, 1e-8);
  for (const Group& g : r.groups) {
    if (g.end == Cycle::End::kRunEnd || g.status != Cycle::Status::kConverged) continue;
    EXPECT_NEAR(g.restitution_out / g.restitution_in, 1, 2e-8) << g.contact << " " << g.number;
  }
}

INSTANTIATE_TEST_SUITE_P(Slow, LongRow,
                         ::testing::Values(LongRowCase{Kind::kColumn, 17, 4'000'000},
                                           LongRowCase{Kind::kColumn, 22, 2'000'000}),
                         LongRowName);

// Neighbours that no pass had seen to end had a guessed μ when the first group was recorded.
TEST(LongRow, AGroupIsFinalWhenThoseThatOverlapItWereSeenToEnd) {
  const Record r = RunOf({Kind::kLong, 71, 1'000'000});
  EXPECT_TRUE(IsSolved(r)) << r.outcome.message;
  EXPECT_EQ(std::ranges::count(r.groups, Cycle::Status::kNotConverged, &Group::status), 0);
}

// The front that one solution brings back after another, where an encounter parts in two by a
// graze, went on for ever.
TEST(LongRowSearch, BlocksThatTakeTurnsEnd) {
  if (!testing::kOptimized) GTEST_SKIP() << "takes minutes in this build";
  EXPECT_TRUE(IsSolved(RunOf({Kind::kLong, 11, 3'000'000})));
}

// What was guessed of contacts that the pulse reached early was 30 times too small, stayed so, and
// made them rattle: 32, 300 and 62 thousand steps, and groups that grew into what was none.
TEST(LongRowGuess, APoorOneIsMadeAgain) {
  if (!testing::kOptimized) GTEST_SKIP() << "takes minutes in this build";
  struct Row {
    std::size_t balls;
    double restitution;
    std::int64_t steps;
  };
  for (const auto& [balls, restitution, steps] :
       {Row{40, 0.9, 30'000}, Row{100, 0.7, 55'000}, Row{40, 0.5, 120'000}}) {
    const std::vector<double> stiffnesses(balls - 1, 1e8), restitutions(balls - 1, restitution);
    Scenario scenario =
        testing::Chain(std::vector<double>(balls, 0.5), stiffnesses, restitutions, 0.2, 0.02);
    scenario.solver.max_steps = steps;
    Record r;
    r.outcome = RunWhole(scenario, r);
    ASSERT_EQ(r.outcome.end, Outcome::End::kFinished) << restitution << r.outcome.message;
    EXPECT_TRUE(r.outcome.all_converged) << restitution;
    EXPECT_LE(r.outcome.growths, 1) << restitution;
    EXPECT_GT(r.groups.size(), 25U) << restitution;
  }
}

// After the pulse balls lean on each other. Their second groups change between negligible and not
// (40 balls), act back on groups that ended before others did that overlap them (80), and undo what
// was solved without them, by turns (70).
TEST(LongRowTail, IsFull) {
  if (!testing::kOptimized) GTEST_SKIP() << "takes minutes in this build";
  struct Row {
    std::size_t balls;
    double restitution, end_time;
  };
  for (const auto& [balls, restitution, end] :
       {Row{40, 0.5, 0.06}, Row{80, 0.7, 0.06}, Row{70, 0.7, 0.05}}) {
    const std::vector<double> stiffnesses(balls - 1, 1e8), restitutions(balls - 1, restitution);
    Scenario scenario =
        testing::Chain(std::vector<double>(balls, 0.5), stiffnesses, restitutions, 0.2, end);
    scenario.solver.max_steps = 5'000'000;
    const Record r = RunAndRecord(scenario);
    ASSERT_EQ(r.outcome.end, Outcome::End::kFinished) << balls << r.outcome.message;
    EXPECT_TRUE(r.outcome.all_converged) << balls;
  }
}

// A group that the run cuts in one pass and not in the next does not keep the search going.
TEST(LongRowSearch, AGroupThatTheRunCutsByTurnsIsSolved) {
  EXPECT_TRUE(IsSolved(RunOf({Kind::kRattler, 33, 1'000'000})));
}

// With μ on the other side of a trough it took in the same cycle again, without end.
TEST(LongRowSearch, AGroupLastsLongerWhenItGrows) {
  for (const auto& [name, seed] : {std::pair("exponents", 3U), {"clamped", 129U}}) {
    int kind = 0;
    while (testing::NameOfKind(kind) != name) ++kind;
    Scenario scenario = testing::RollKind(kind, seed);
    scenario.solver.max_steps = 1'000'000;
    EXPECT_TRUE(IsSolved(RunAndRecord(scenario))) << name;
  }
}

// Coarse passes from a state that an exact one had kept saw a cycle that those from the start did
// not: two blocks took turns until the last round.
TEST(LongRowSearch, PassesFromTheStartAndFromAKeptStateSeeTheSame) {
  EXPECT_TRUE(IsSolved(RunOf({Kind::kCradle, 1, 1'000'000})));
}

// From 0.45 s on the ball rattles and stays closed. What the load drives moves however large μ is:
// two or three groups give back at least 0.8087 with every μ. They are told as that, and all others
// have their answer.
TEST(DrivenWall, IsAnsweredInFewStepsWhereTheBallRattles) {
  if (!testing::kOptimized) GTEST_SKIP() << "takes minutes in this build";
  Scenario scenario = testing::SpringWall();
  scenario.contacts[0].restitution = 0.8;
  scenario.end_time = 1;
  scenario.solver.max_steps = 7'000'000;
  const Record r = RunAndRecord(scenario);
  ASSERT_EQ(r.outcome.end, Outcome::End::kFinished) << r.outcome.message;
  int infeasible = 0;
  for (const Group& g : r.groups) {
    EXPECT_NE(g.status, Cycle::Status::kNotConverged) << g.number;
    if (g.status != Cycle::Status::kInfeasible) continue;
    ++infeasible;
    EXPECT_GT(g.start_time, 0.45);
    EXPECT_NEAR(g.too_much.restitution, 0.8087, 1e-3);
    EXPECT_TRUE(std::isnan(g.too_little.mu));
  }
  EXPECT_LE(infeasible, 3);
}

}  // namespace
}  // namespace contact
