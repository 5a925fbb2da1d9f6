#include "cli/paper/cases.h"

#include <gmock/gmock.h>

#include "cli/input/no_limits.h"
#include "wire/scenario/scenario_codec.h"

namespace contact::cli {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

std::vector<v1::Scenario> AllCases() {
  return {TripleChain(0.8, 0.7), SpringWall(), Collisions({0.1, 0.9}, v1::Contact::FLORES)};
}

TEST(PaperCases, KeepTheRulesOfScenariosHoweverTheyAreSolved) {
  for (v1::Scenario scenario : AllCases()) {
    SCOPED_TRACE(scenario.title());
    EXPECT_THAT(DecodeScenario(scenario, kNoLimits).violations, IsEmpty());
    SolveAsPaper(&scenario, v1::Solver::PAPER_NEWTON, 0.005);
    EXPECT_THAT(DecodeScenario(scenario, kNoLimits).violations, IsEmpty());
    SplitAtPeakForce(&scenario);
    EXPECT_THAT(DecodeScenario(scenario, kNoLimits).violations, IsEmpty());
    UseLaw(&scenario, v1::Contact::HUNT_CROSSLEY, 0.8, 0.2);
    EXPECT_THAT(DecodeScenario(scenario, kNoLimits).violations, IsEmpty());
  }
}

TEST(PaperCases, BallsOfTheChainTouchAtTheStart) {
  const v1::Scenario chain = TripleChain(0.8, 0.7, 0.3);
  ASSERT_THAT(chain.bodies(), SizeIs(3));
  EXPECT_EQ(chain.bodies(0).velocity_m_per_s(), 0.3);
  for (int i = 1; i < 3; ++i) {
    EXPECT_DOUBLE_EQ(chain.bodies(i).position_m() - chain.bodies(i - 1).position_m(),
                     chain.bodies(i).radius_m() + chain.bodies(i - 1).radius_m());
    EXPECT_EQ(chain.bodies(i).velocity_m_per_s(), 0);
  }
  EXPECT_EQ(chain.contacts(0).restitution(), 0.8);
  EXPECT_EQ(chain.contacts(1).restitution(), 0.7);
}

TEST(PaperCases, CollisionsDoNotDisturbEachOther) {
  const v1::Scenario scenario = Collisions({0.2, 0.5, 0.8}, v1::Contact::EXACT);
  ASSERT_THAT(scenario.contacts(), SizeIs(3));
  for (int i = 0; i < 3; ++i) {
    const v1::Body& ball = scenario.bodies(i);
    EXPECT_EQ(scenario.contacts(i).name(), std::to_string(i));
    EXPECT_EQ(scenario.contacts(i).between(0), ball.name());
    EXPECT_EQ(ball.velocity_m_per_s(), kStudyVelocity);
    // Each ball touches its own wall at the start.
    EXPECT_DOUBLE_EQ(ball.position_m() + ball.radius_m(), scenario.contacts(i).wall().position_m());
  }
  EXPECT_TRUE(scenario.output().ledger_only());
}

TEST(PaperCases, SpringIsPushedByTheLoadsOfThePaper) {
  const v1::Scenario scenario = SpringWall();
  ASSERT_THAT(scenario.loads(), SizeIs(2));
  EXPECT_EQ(scenario.loads(0).constant().force_n(), 500);
  EXPECT_EQ(scenario.loads(1).sine().amplitude_n(), 250);
  EXPECT_EQ(scenario.loads(1).sine().angular_frequency_rad_per_s(), 2000);
}

TEST(PaperCases, LedgerOnlyForgetsTheSampling) {
  v1::Scenario scenario = TripleChain(0.8, 0.7);
  RecordLedgerOnly(&scenario);
  EXPECT_TRUE(scenario.output().ledger_only());
  EXPECT_FALSE(scenario.output().has_sample_interval_s());
}

TEST(PaperCases, ReferenceVelocityIsThatOfEveryContact) {
  v1::Scenario scenario = TripleChain(0.8, 0.7);
  UseReferenceVelocity(&scenario, 0.2);
  for (const v1::Contact& contact : scenario.contacts()) {
    EXPECT_EQ(contact.reference_velocity_m_per_s(), 0.2);
  }
}

}  // namespace
}  // namespace contact::cli
