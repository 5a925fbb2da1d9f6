#include "rpc/shutdown_timer.h"

#include <gtest/gtest.h>

#include <atomic>

#include "test_server.h"

namespace contact {
namespace {

using namespace std::chrono_literals;

struct Calls {
  std::atomic<int> urged = 0;
  std::atomic<int> given_up = 0;
};

TEST(ShutdownTimerTest, ActionsComeInOrderWhileItLives) {
  Calls calls;
  const ShutdownTimer timer(
      0ms, [&] { ++calls.urged; }, 1ms,
      [&] {
        EXPECT_EQ(calls.urged, 1);
        ++calls.given_up;
      });
  EXPECT_TRUE(Eventually([&] { return calls.given_up == 1; }));
}

TEST(ShutdownTimerTest, NothingHappensOnceItIsDestroyed) {
  Calls calls;
  {
    const ShutdownTimer timer(
        1h, [&] { ++calls.urged; }, 2h, [&] { ++calls.given_up; });
  }
  EXPECT_EQ(calls.urged, 0);
  EXPECT_EQ(calls.given_up, 0);
}

TEST(ShutdownTimerTest, UrgingMayBeEnough) {
  Calls calls;
  {
    const ShutdownTimer timer(
        0ms, [&] { ++calls.urged; }, 1h, [&] { ++calls.given_up; });
    EXPECT_TRUE(Eventually([&] { return calls.urged == 1; }));
  }
  EXPECT_EQ(calls.given_up, 0);
}

}  // namespace
}  // namespace contact
