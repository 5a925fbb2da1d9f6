#include "gateway/net/memory.h"

#include <gtest/gtest.h>

namespace contact::gateway {
namespace {

constexpr std::size_t kMost = 1 << 20;

TEST(MemoryTest, NoMoreIsTakenThanThereIsUntilItIsGivenBack) {
  Memory memory(kMost);
  Memory::Share all = memory.Take(kMost);
  EXPECT_TRUE(all);
  EXPECT_FALSE(memory.Take(kMost / 2));
  all.reset();
  EXPECT_TRUE(memory.Take(kMost));
}

TEST(MemoryTest, WhatIsRefusedTakesNothing) {
  Memory memory(kMost);
  EXPECT_FALSE(memory.Take(kMost + 1));
  EXPECT_TRUE(memory.Take(kMost));
}

TEST(MemoryTest, ASmallMessageNeverLacksRoom) {
  Memory memory(kMost);
  const Memory::Share all = memory.Take(kMost);
  EXPECT_TRUE(memory.Take(1000));
}

}  // namespace
}  // namespace contact::gateway
