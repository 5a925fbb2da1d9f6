// Each result is certified by an independent integration.
#include <gtest/gtest.h>

#include <string>

#include "simulation/kinds.h"
#include "simulation/proof/independent.h"

namespace contact {
namespace {

using testing::Kind;

class EveryKind : public ::testing::TestWithParam<int> {};

TEST_P(EveryKind, IsConfirmedByAnIndependentIntegration) {
  for (unsigned seed = 2000; seed < 2000 + (testing::kOptimized ? 24 : 4); ++seed) {
    const Scenario scenario = testing::Dice(seed, static_cast<Kind>(GetParam())).Roll();
    const testing::Record run = testing::RunAndRecord(scenario);
    const testing::Disagreement miss = testing::CompareWithIndependent(scenario, run);
    SCOPED_TRACE(seed);
    // At their ends, where F δ̇ = 0, pressed cycles hardly move: their instants matter less.
    const bool pressed = GetParam() == static_cast<int>(Kind::kPressed);
    EXPECT_LT(miss.velocity, 1e-8);
    EXPECT_LT(miss.restitution, 1e-8);
    EXPECT_LT(miss.time, pressed ? 2e-7 : 1e-8);
    EXPECT_LT(miss.worst, pressed ? 2e-8 : 1e-8) << miss.where;
    EXPECT_LT(miss.overlap, 1e-8);
    EXPECT_EQ(miss.checked_until, scenario.end_time);
  }
}

INSTANTIATE_TEST_SUITE_P(Certificate, EveryKind, ::testing::Range(0, testing::kSmallKinds),
                         [](const auto& made) {
                           return std::string(testing::kKindNames[made.param]);
                         });

}  // namespace
}  // namespace contact
