#include "jobs/watches.h"

#include <gmock/gmock.h>

namespace contact {
namespace {

TEST(MessageBytes, TheMessagesOfAllWatchersHaveABoundedNumber) {
  EXPECT_EQ(MessageBytes(0), 256U << 10);
  EXPECT_EQ(MessageBytes(1), 256U << 10);
  for (const int watchers : {100, 256, 1000, 3072}) {
    EXPECT_LE(static_cast<std::size_t>(watchers) * MessageBytes(watchers), 24U << 20);
  }
  EXPECT_EQ(MessageBytes(1000), (24U << 20) / 1000);
  EXPECT_EQ(MessageBytes(10'000), 8U << 10);
}

}  // namespace
}  // namespace contact
