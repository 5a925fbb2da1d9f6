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

// One group in forty may be missed: for groups that only another μ brings about the search has
// other guesses than this scan, and so sees another motion. 25 of 1,273 are, whatever the steps and
// the limits of the search's own scan.
TEST(SmallestRoot, IsTheAnswer) {
  if (!testing::kOptimized) GTEST_SKIP() << "needs them all: two of the first 42 are missed";
  int looked = 0, told = 0, missed = 0;
  for (int kind = 0; kind < testing::kSmallKinds; ++kind) {
    for (unsigned seed = 3000; seed < 3060; ++seed) {
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
  EXPECT_GT(looked, 1000);
  EXPECT_GE(told, 10);
  EXPECT_LE(missed, looked / 40) << "of " << looked;
  RecordProperty("groups", looked);
  RecordProperty("with larger roots", told);
}

// A contact that begins at rest, of which a μ of some 3.5e6 solves the balance, too.
TEST(SmallestRoot, IsTheSameWhereTheRunEndsLater) {
  for (const double later : {1.0, 1.31}) {
    Scenario scenario = testing::Dice(41, Kind::kWall).Roll();
    scenario.end_time *= later;
    const testing::Record run = testing::RunAndRecord(scenario);
    const auto group = std::ranges::find(run.groups, 1, &Group::contact);
    ASSERT_NE(group, run.groups.end());
    EXPECT_NEAR(group->mu, 104'928.3, 0.1);
  }
}

}  // namespace
}  // namespace contact
