// The same scenario in other words has the same answers.
#include "simulation/proof/metamorphic.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace contact::testing {
namespace {

using ::testing::Contains;
using ::testing::Not;

std::vector<std::string> WaysOf(const Scenario& s) {
  std::vector<std::string> ways;
  for (const Restated& r : Restate(s)) ways.emplace_back(r.how);
  return ways;
}

// Two balls, a touch apart, that fall together.
Scenario Falling() {
  Scenario s = Chain({0.5, 0.3}, {1e7}, {0.6}, 0.4, 0.02);
  s.bodies[1].position += 1e-3;
  s.loads = {{.body = 0, .constant = -4.905}, {.body = 1, .constant = -2.943}};
  return s;
}

TEST(OtherWords, AreThoseThatSuitTheScenario) {
  EXPECT_EQ(WaysOf(Falling()).size(), 9u);
  EXPECT_THAT(WaysOf(SpringWall()), Not(Contains("from a moving frame")));
  EXPECT_THAT(WaysOf(SpringWall()), Not(Contains("begun earlier")));
  EXPECT_THAT(WaysOf(TripleChain()), Not(Contains("with loads in halves")));
}

TEST(OtherWords, HaveTheSameAnswers) {
  for (const Scenario& s : {Falling(), TripleChain(), SpringWall()}) {
    const Record run = RunAndRecord(s);
    const Difference found = CompareWithOtherWords(s, run);
    EXPECT_LT(found.worst, 1e-6) << found.where;
  }
}

// Lengths and times 16 and 8 times smaller: floors in absolute units would make a difference.
TEST(OtherWords, InOtherUnitsChangeNothingButRoundOff) {
  const Scenario s = Falling();
  const std::vector<Restated> all = Restate(s);
  const auto units = std::ranges::find(all, "in other units", &Restated::how);
  EXPECT_LT(Compare(s, RunAndRecord(s), *units, RunAndRecord(units->scenario)).worst, 1e-10);
}

// Breaks the answers of the other run, each of which is then told.
TEST(OtherWords, ThatHaveAnotherAnswerAreTold) {
  const Scenario s = Falling();
  const Record run = RunAndRecord(s);
  for (const Restated& other : Restate(s)) {
    SCOPED_TRACE(other.how);
    const Record again = RunAndRecord(other.scenario);
    const auto worst = [&](auto change) {
      Record wrong = again;
      change(wrong);
      return Compare(s, run, other, wrong).worst;
    };
    EXPECT_LT(Compare(s, run, other, again).worst, 1e-7);
    EXPECT_GT(worst([](Record& r) { r.groups[0].mu *= 1 + 1e-5; }), 9e-6);
    EXPECT_GT(worst([](Record& r) { r.cycles[0].peak_force *= 1 - 1e-5; }), 9e-6);
    EXPECT_EQ(worst([](Record& r) { r.groups.clear(); }), 1);
    if (other.longer) continue;
    EXPECT_GT(worst([](Record& r) { r.outcome.velocities[0] += 1e-5; }), 9e-6);
    EXPECT_EQ(worst([](Record& r) { r.outcome.all_converged = false; }), 1);
  }
}

}  // namespace
}  // namespace contact::testing
