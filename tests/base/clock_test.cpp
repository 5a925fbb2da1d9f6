#include "base/clock.h"

#include <gtest/gtest.h>

namespace contact {
namespace {

TEST(SystemClockTest, ElapsedNeverGoesBack) {
  auto last = SystemClock().Elapsed();
  for (int i = 0; i < 1000; ++i) {
    const auto now = SystemClock().Elapsed();
    ASSERT_GE(now, last);
    last = now;
  }
}

TEST(SystemClockTest, NowIsTheTimeOfTheSystem) {
  const auto before = std::chrono::system_clock::now();
  const auto now = SystemClock().Now();
  EXPECT_GE(now, before);
  EXPECT_LE(now, std::chrono::system_clock::now());
}

}  // namespace
}  // namespace contact
