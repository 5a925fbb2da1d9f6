// What is foretold of a run, against closed forms and the run itself.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simulation/forecast/first_meeting.h"
#include "simulation/forecast/run_estimate.h"
#include "simulation/model/window.h"
#include "testing/cases.h"

namespace contact {
namespace {

TEST(ImpactDuration, OfALinearContactIsHalfAPeriod) {
  EXPECT_NEAR(ImpactDuration(0.3, 2, 5e7, 1), std::numbers::pi * std::sqrt(0.3 / 5e7), 1e-16);
}

TEST(ImpactDuration, OfAnElasticCollisionIsThatOfTheRun) {
  for (const double n : {1.0, 1.5, 2.5}) {
    const testing::Record r = testing::RunAndRecord(testing::Collision(0.3, 2, 5e7, n, 1));
    ASSERT_EQ(r.cycles.size(), 1u);
    const double lasted = r.cycles[0].end_time - r.cycles[0].start_time;
    EXPECT_NEAR(ImpactDuration(0.3, 2, 5e7, n) / lasted, 1, 1e-9) << n;
  }
}

TEST(SwingPeriod, OfALinearContactIsThatOfItsSpring) {
  EXPECT_NEAR(SwingPeriod(0.3, 700, 5e7, 1), 2 * std::numbers::pi * std::sqrt(0.3 / 5e7), 1e-16);
}

TEST(FirstMeeting, OfAContactIsTheStartOfItsFirstCycle) {
  Scenario s = testing::Collision(0.3, 2, 5e7, 1.5, 0.7);
  s.bodies[0].position -= 0.01;
  s.loads = {{.body = 0, .constant = 30}};
  s.end_time = 0.01;
  const auto meetings = ForecastFirstMeetings(s);
  ASSERT_TRUE(meetings.at(0));
  const testing::Record r = testing::RunAndRecord(s);
  ASSERT_FALSE(r.cycles.empty());
  EXPECT_NEAR(meetings[0]->start, r.cycles[0].start_time, 1e-12);
  EXPECT_NEAR(meetings[0]->speed, r.cycles[0].approach_velocity, 1e-9);
}

TEST(RunEstimate, OfABallThatNeverMeetsAnythingHasNoCycles) {
  Scenario s = testing::Collision(0.3, -2, 5e7, 1.5, 0.7);
  s.end_time = 1;
  EXPECT_LT(EstimateRunOf(s).steps, 2);
  s.solver.fixed_step = 1e-3;
  EXPECT_NEAR(EstimateRunOf(s).steps, 1000, 1e-9);
}

TEST(RunEstimate, CountsNoMoreSensitivitiesThanAWindowHolds) {
  // A ball pressed against a wall bounces for ever: the longer the run, the more cycles.
  const auto memory_per_ledger = [](double from, double to) {
    Scenario s = testing::Collision(0.3, 2, 5e7, 1.5, 0.9999);
    s.loads = {{.body = 0, .constant = 1000}};
    s.end_time = from;
    const RunEstimate less = EstimateRunOf(s);
    s.end_time = to;
    const RunEstimate more = EstimateRunOf(s);
    return (more.memory_bytes - less.memory_bytes) / (more.ledger_bytes - less.ledger_bytes);
  };
  // With room in the window a cycle takes its row and the sensitivities to its μ; then its row
  // only.
  EXPECT_GT(memory_per_ledger(0.005, 0.01), 1);
  EXPECT_LT(memory_per_ledger(1, 2), 0.5);
}

TEST(MostWindowCycles, GrowsWithTheContactsBetweenItsBounds) {
  EXPECT_GE(MostWindowCycles(0), kFewestWindowCycles);
  EXPECT_EQ(MostWindowCycles(10), 10 + kSpareWindowCycles);
  EXPECT_EQ(MostWindowCycles(100'000), kMostWindowCycles);
}

}  // namespace
}  // namespace contact
