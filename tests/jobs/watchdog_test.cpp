#include "jobs/schedule/watchdog.h"

#include <gmock/gmock.h>

namespace contact {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class WatchdogTest : public testing::Test {
 protected:
  // Looks every so often for so long; true: the run is to be given up.
  bool Pass(milliseconds time, RunControl& run, milliseconds step = milliseconds(500)) {
    bool lost = false;
    for (milliseconds passed{0}; passed < time; passed += step) {
      lost = watchdog_.Look(run, now_ += step, kPatience);
    }
    return lost;
  }

  static constexpr Watchdog::Patience kPatience{seconds(60), seconds(5)};
  Watchdog::Time now_{};
  Watchdog watchdog_{now_};
};

TEST_F(WatchdogTest, RunThatMakesStepsIsLeftAlone) {
  RunControl run;
  for (int i = 0; i < 10; ++i) {
    EXPECT_FALSE(Pass(seconds(59), run));
    run.CountStep();
  }
  EXPECT_FALSE(run.stopping());
}

TEST_F(WatchdogTest, SamplesAreSignsOfLifeToo) {
  RunControl run;
  Pass(seconds(59), run);
  run.CountOutput(8);
  Pass(seconds(59), run);
  EXPECT_FALSE(run.stopping());
}

TEST_F(WatchdogTest, RunWithoutAStepIsStoppedAndThenGivenUp) {
  RunControl run;
  EXPECT_FALSE(Pass(seconds(61), run));
  EXPECT_EQ(run.cause(), StopCause::kStalled);
  EXPECT_FALSE(Pass(seconds(4), run));
  EXPECT_TRUE(Pass(seconds(2), run));
}

TEST_F(WatchdogTest, RunThatWaitsForTheDiskIsNotStalled) {
  RunControl run;
  {
    const RunControl::Hold hold(run);
    EXPECT_FALSE(Pass(seconds(600), run));
    run.Stop(StopCause::kUser);
    EXPECT_FALSE(Pass(seconds(600), run));
    EXPECT_FALSE(run.GiveUp());
  }
  EXPECT_EQ(run.cause(), StopCause::kUser);
}

TEST_F(WatchdogTest, PauseOfTheWholeProcessIsNoStall) {
  RunControl run;
  EXPECT_FALSE(Pass(seconds(3600), run, seconds(3600)));
  EXPECT_FALSE(run.stopping());
}

TEST_F(WatchdogTest, WallTimeEndsARunThatGoesWell) {
  RunControl run({.wall_time = seconds(3)});
  for (int i = 0; i < 5; ++i) {
    run.CountStep();
    Pass(milliseconds(500), run);
  }
  EXPECT_FALSE(run.stopping());
  Pass(milliseconds(500), run);
  EXPECT_EQ(run.cause(), StopCause::kWallTime);
}

TEST(RunControl, FirstCauseCounts) {
  RunControl run({.steps = 2, .output_bytes = 10});
  run.Stop();
  EXPECT_TRUE(run.stopping());
  run.Stop(StopCause::kUser);
  EXPECT_FALSE(run.CountOutput(11));
  EXPECT_EQ(run.cause(), StopCause::kUser) << "the end of the server is no cause of the job's";
}

TEST(RunControl, BudgetsHoldToTheLast) {
  RunControl run({.steps = 2, .output_bytes = 10});
  run.CountStep();
  run.CountStep();
  EXPECT_TRUE(run.CountOutput(10));
  EXPECT_FALSE(run.stopping());
  run.CountStep();
  EXPECT_EQ(run.cause(), StopCause::kSteps);
  EXPECT_FALSE(run.CountOutput(1));
}

TEST(RunControl, JobGetsWhatItAsksForUpToTheLimit) {
  v1::Job job;
  job.mutable_budget()->set_steps(5);
  job.mutable_budget()->set_output_bytes(50);
  const RunBudget budget = BudgetOf(job, {seconds(7), 10, 20});
  EXPECT_EQ(budget.wall_time, seconds(7));
  EXPECT_EQ(budget.steps, 5);
  EXPECT_EQ(budget.output_bytes, 20);
  EXPECT_EQ(BudgetOf(job, {}).steps, 5);
  EXPECT_EQ(BudgetOf({}, {}).steps, 0);
}

TEST(RunControl, NobodyListensToARunThatWasGivenUp) {
  RunControl run;
  EXPECT_TRUE(RunControl::Hold(run));
  EXPECT_TRUE(run.GiveUp());
  EXPECT_FALSE(RunControl::Hold(run));
}

}  // namespace
}  // namespace contact
