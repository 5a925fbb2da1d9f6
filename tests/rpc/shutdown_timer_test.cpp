#include "rpc/shutdown_timer.h"

#include <gtest/gtest.h>

#include <atomic>

#include "test_server.h"

namespace contact {
namespace {

using namespace std::chrono_literals;

TEST(ShutdownTimerTest, GivesUpWhileItLives) {
  std::atomic<int> given_up = 0;
  const ShutdownTimer timer(1ms, [&] { ++given_up; });
  EXPECT_TRUE(Eventually([&] { return given_up == 1; }));
}

TEST(ShutdownTimerTest, NothingHappensOnceItIsDestroyed) {
  std::atomic<int> given_up = 0;
  {
    const ShutdownTimer timer(1h, [&] { ++given_up; });
  }
  EXPECT_EQ(given_up, 0);
}

}  // namespace
}  // namespace contact
