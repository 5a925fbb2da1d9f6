// Of several μ that give back what was asked for the smallest is the answer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "simulation/kinds.h"
#include "simulation/replay.h"

namespace contact {
namespace {

using testing::Kind;
using testing::Replay;
using testing::Traced;

bool IsSought(const Group& group) {
  return group.status == Cycle::Status::kConverged && group.end != Cycle::End::kRunEnd &&
         group.restitution_in < 1;
}

// A μ below the root of a group that solves it, too, where a fine scan finds one; else 0.
double SmallerRoot(Replay& replay, const Group& group) {
  constexpr double kFine = 1.1;
  double before = replay.Excess(0), last = 0;
  for (double mu = 1e-3 * group.mu; mu < 0.9 * group.mu; last = mu, mu *= kFine) {
    const double excess = replay.Excess(mu);
    const bool crosses = before * excess < 0;
    if (crosses && (before > 0 ? HasRoot(replay, last, mu) : HasRoot(replay, mu, last))) return mu;
    before = excess;
  }
  return 0;
}

// What comes after a group is guessed anew in each look of the scan, and was known to the search:
// of some in a hundred groups between gaps that makes a root.
TEST(SmallestRoot, IsTheAnswer) {
  int looked = 0, told = 0, missed = 0;
  for (int kind = 0; kind < testing::kSmallKinds; ++kind) {
    for (unsigned seed = 3000; seed < 3000 + (testing::kOptimized ? 20 : 2); ++seed) {
      const Scenario scenario = testing::Dice(seed, static_cast<Kind>(kind)).Roll();
      Traced run;
      run.outcome = contact::Run(scenario, run);
      for (const Group& group : run.groups) {
        if (!IsSought(group)) continue;
        ++looked;
        told += !group.other_roots.empty();
        for (const double mu : group.other_roots) EXPECT_GT(mu, group.mu);
        Replay replay(scenario, run, group);
        missed += SmallerRoot(replay, group) > 0;
      }
    }
  }
  EXPECT_GT(looked, testing::kOptimized ? 300 : 20);
  EXPECT_GE(told, testing::kOptimized ? 3 : 0);
  EXPECT_LE(missed, looked / 100) << "of " << looked;
  RecordProperty("groups", looked);
  RecordProperty("with larger roots", told);
}

TEST(SmallestRoot, DoesNotDependOnTheEndOfTheRun) {
  Scenario scenario = testing::Dice(41, Kind::kWall).Roll();
  const testing::Record whole = testing::RunAndRecord(scenario);
  const auto several = std::ranges::find_if(
      whole.groups, [](const Group& group) { return !group.other_roots.empty(); });
  ASSERT_NE(several, whole.groups.end());
  scenario.end_time = 1.31 * scenario.end_time;
  const testing::Record longer = testing::RunAndRecord(scenario);
  for (const Group& group : longer.groups) {
    if (group.contact != several->contact || group.number != several->number) continue;
    EXPECT_NEAR(group.mu / several->mu, 1, 1e-6);
    EXPECT_EQ(group.other_roots.size(), several->other_roots.size());
  }
}

}  // namespace
}  // namespace contact
