#include "cli/base/interrupt.h"

#include <gmock/gmock.h>

#include <csignal>

namespace contact::cli {
namespace {

TEST(Interrupt, TheFirstCtrlCIsOnlyNoted) {
  {
    const Interrupt interrupt;
    EXPECT_FALSE(Interrupt::raised());
    std::raise(SIGINT);
    EXPECT_TRUE(Interrupt::raised());
  }
  const Interrupt next;
  EXPECT_FALSE(Interrupt::raised());
}

TEST(InterruptDeathTest, TheSecondCtrlCEndsTheProcess) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        const Interrupt interrupt;
        std::raise(SIGINT);
        std::raise(SIGINT);
      },
      testing::KilledBySignal(SIGINT), "");
}

TEST(InterruptDeathTest, WithoutAnInterruptCtrlCEndsTheProcess) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        { const Interrupt interrupt; }
        std::raise(SIGINT);
      },
      testing::KilledBySignal(SIGINT), "");
}

}  // namespace
}  // namespace contact::cli
