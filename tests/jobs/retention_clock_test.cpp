#include "jobs/schedule/retention_clock.h"

#include <gtest/gtest.h>

#include "testing/fake_sources.h"
#include "testing/temp_directory.h"

namespace contact {
namespace {

using std::chrono::hours;
using std::chrono::minutes;

constexpr hours kYear{24 * 365};

class RetentionClockTest : public testing::Test {
 protected:
  std::chrono::system_clock::duration SinceStart(RetentionClock& clock) const {
    return clock.Now() - start_;
  }

  TempDirectory folder_;
  const std::filesystem::path file_ = folder_.path() / "clock";
  FakeClock wall_;
  const RetentionClock::Time start_ = wall_.Now();
};

TEST_F(RetentionClockTest, GoesWithTheTimeThatPassesAndNotWithJumps) {
  RetentionClock clock(wall_, "");
  wall_.Advance(hours(5));
  EXPECT_EQ(SinceStart(clock), hours(5));
  wall_.Jump(kYear);
  EXPECT_EQ(SinceStart(clock), hours(5));
  wall_.Advance(hours(2));
  EXPECT_EQ(SinceStart(clock), hours(7));
  wall_.Jump(-kYear);
  EXPECT_EQ(SinceStart(clock), hours(7));
}

TEST_F(RetentionClockTest, IsNeverAheadOfTheWallClockAndReturnsWithIt) {
  RetentionClock clock(wall_, "");
  wall_.Jump(-kYear);
  EXPECT_EQ(SinceStart(clock), -kYear);
  wall_.Advance(hours(3));
  wall_.Jump(kYear);
  EXPECT_EQ(SinceStart(clock), hours(3));
}

TEST_F(RetentionClockTest, FollowsSmallCorrections) {
  RetentionClock clock(wall_, "");
  for (int i = 1; i <= 10; ++i) {
    wall_.Jump(minutes(60));
    EXPECT_EQ(SinceStart(clock), minutes(60 * i));
  }
}

TEST_F(RetentionClockTest, CountsADayAtMostWhileNobodyWatches) {
  RetentionClock(wall_, file_).Now();
  wall_.Jump(hours(20));
  RetentionClock night(wall_, file_);
  EXPECT_EQ(SinceStart(night), hours(20));
  wall_.Jump(kYear);
  RetentionClock year(wall_, file_);
  EXPECT_EQ(SinceStart(year), hours(44));
  wall_.Jump(-2 * kYear);
  EXPECT_LT(SinceStart(year), hours(0));
  RetentionClock back(wall_, file_);
  wall_.Jump(2 * kYear);
  EXPECT_GE(SinceStart(back), hours(44)) << "a clock that stood too low is forgotten";
}

}  // namespace
}  // namespace contact
