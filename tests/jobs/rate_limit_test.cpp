#include "jobs/quota/rate_limit.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>

namespace contact {
namespace {

using namespace std::chrono_literals;

const RateLimit::Time kStart{};

TEST(RateLimitTest, BurstGoesThroughAndTheNextIsToldWhen) {
  RateLimit limit(4, 3);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(limit.Take("a", kStart), 0ms) << i;
  EXPECT_EQ(limit.Take("a", kStart), 250ms);
  EXPECT_EQ(limit.Take("a", kStart + 100ms), 150ms);
  EXPECT_EQ(limit.Take("a", kStart + 250ms), 0ms);
  EXPECT_EQ(limit.Take("a", kStart + 250ms), 250ms);
}

TEST(RateLimitTest, RestFillsTheBucketUpToTheBurst) {
  RateLimit limit(4, 3);
  limit.Take("a", kStart);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(limit.Take("a", kStart + 1h), 0ms) << i;
  EXPECT_GT(limit.Take("a", kStart + 1h), 0ms);
}

TEST(RateLimitTest, PeersDoNotShare) {
  RateLimit limit(1, 1);
  EXPECT_EQ(limit.Take("a", kStart), 0ms);
  EXPECT_EQ(limit.Take("b", kStart), 0ms);
  EXPECT_GT(limit.Take("a", kStart), 0ms);
}

TEST(RateLimitTest, ZeroIsAnyNumber) {
  RateLimit limit(0, 1);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(limit.Take("a", kStart), 0ms);
  EXPECT_EQ(limit.peers(), 0U);
}

TEST(RateLimitTest, PeersThatRestAreForgotten) {
  RateLimit limit(1, 1);
  for (int i = 0; i < 100'000; ++i) limit.Take(std::to_string(i), kStart + i * 10ms);
  EXPECT_LE(limit.peers(), 1024U);
}

TEST(RateLimitTest, TellsWhatWasTakenAndHasNotComeBack) {
  RateLimit limit(4, 3);
  EXPECT_EQ(limit.TakenBy("a", kStart), 0);
  for (int i = 0; i < 3; ++i) limit.Take("a", kStart);
  EXPECT_EQ(limit.TakenBy("a", kStart), 3);
  EXPECT_EQ(limit.TakenBy("a", kStart + 500ms), 1);
  EXPECT_EQ(limit.TakenBy("a", kStart + 1h), 0);
}

}  // namespace
}  // namespace contact
