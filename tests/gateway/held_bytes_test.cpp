#include "gateway/net/held_bytes.h"

#include <gtest/gtest.h>

namespace contact::gateway {
namespace {

TEST(HeldBytes, PastTheMostTheHeaviestIsCutOnceAndCountsNoMore) {
  HeldBytes held(100);
  int light_cut = 0, heavy_cut = 0;
  HeldBytes::Account light(held, [&] { ++light_cut; });
  HeldBytes::Account heavy(held, [&] { ++heavy_cut; });
  heavy.Add(80);
  light.Add(20);
  EXPECT_EQ(heavy_cut, 0);
  light.Add(1);
  EXPECT_EQ(heavy_cut, 1) << "who is lighter may bring the sum over the most";
  EXPECT_EQ(held.bytes(), 21U);
  heavy.Add(500);
  heavy.Sub(580);
  EXPECT_EQ(held.bytes(), 21U);
  light.Sub(21);
  EXPECT_EQ(held.bytes(), 0U);
  EXPECT_EQ(heavy_cut, 1);
  EXPECT_EQ(light_cut, 0);
}

TEST(HeldBytes, WhoGoesHoldsNothing) {
  HeldBytes held(100);
  {
    HeldBytes::Account(held, [] {}).Add(50);
  }
  EXPECT_EQ(held.bytes(), 0U);
}

}  // namespace
}  // namespace contact::gateway
