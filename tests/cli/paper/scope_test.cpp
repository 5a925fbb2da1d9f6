// The paper knows cycles only: no case of it needs a group of several.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "cli/input/no_limits.h"
#include "cli/paper/items.h"
#include "testing/cases.h"
#include "testing/fake_lab.h"
#include "wire/scenario/scenario_codec.h"

namespace contact::cli {
namespace {

// The bits of every number of the groups and of the motion's end; a row that the end cuts has NaN.
std::vector<std::uint64_t> Numbers(const contact::testing::Record& run) {
  std::vector<double> numbers = run.outcome.velocities;
  for (const Cycle& cycle : run.cycles) {
    numbers.insert(numbers.end(), {cycle.mu, cycle.end_time, cycle.work_compression,
                                   cycle.work_restitution, double(cycle.status)});
  }
  std::vector<std::uint64_t> bits;
  for (const double number : numbers) bits.push_back(std::bit_cast<std::uint64_t>(number));
  return bits;
}

std::vector<std::uint64_t> Solve(v1::Scenario message, v1::Solver::RestitutionScope scope) {
  message.mutable_solver()->set_restitution_scope(scope);
  const DecodedScenario decoded = DecodeScenario(message, kNoLimits);
  EXPECT_TRUE(decoded.violations.empty());
  const contact::testing::Record run = contact::testing::RunAndRecord(decoded.scenario);
  EXPECT_EQ(run.outcome.growths, 0);
  for (const Group& group : run.groups) EXPECT_EQ(group.cycles, 1);
  return Numbers(run);
}

TEST(PaperScope, EveryCaseIsTheSameUnderAutoAndCycle) {
  FakeLab lab;
  MakePaperItems(PaperItems(), lab);
  ASSERT_GT(lab.asked.size(), 100U);
  for (v1::Scenario& scenario : lab.asked) {
    SCOPED_TRACE(scenario.ShortDebugString());
    scenario.mutable_output()->set_ledger_only(true);
    EXPECT_EQ(Solve(scenario, v1::Solver::CYCLE), Solve(scenario, v1::Solver::AUTO));
  }
}

}  // namespace
}  // namespace contact::cli
