#include <gtest/gtest.h>

#include <cmath>

#include "cli/text/comparison/verification.h"

namespace contact::cli {
namespace {

TEST(Refinement, OrderAndLimitOfAPowerAreExact) {
  for (const double order : {1.0, 2.5, 4.0}) {
    for (const double ratio : {2.0, 10.0}) {
      const auto at = [&](int i) { return 3 - 0.25 * std::pow(ratio, -order * i); };
      const Refinement refinement = Refine(at(0), at(1), at(2), ratio, 0);
      EXPECT_NEAR(refinement.order, order, 1e-6);
      EXPECT_NEAR(refinement.limit, 3, 1e-14);
      EXPECT_TRUE(refinement.settles);
    }
  }
}

TEST(Refinement, NextPowerIsLeftByTheExtrapolation) {
  const auto at = [](double h) { return std::sin(h) / h; };  // 1 − h²/6 + h⁴/120 − …
  const Refinement refinement = Refine(at(0.5), at(0.25), at(0.125), 2, 0);
  EXPECT_NEAR(refinement.order, 2, 0.02);
  EXPECT_NEAR(refinement.limit, 1, 5e-5);
  EXPECT_GT(std::abs(at(0.125) - 1), 2e-3);
}

TEST(Refinement, FinestIsTheLimitOnceTheDifferenceIsAtTheFloor) {
  const Refinement refinement = Refine(3 + 1e-9, 3, 3 + 1e-15, 2, 1e-13);
  EXPECT_TRUE(std::isnan(refinement.order));
  EXPECT_EQ(refinement.limit, 3 + 1e-15);
  EXPECT_TRUE(refinement.settles);
  EXPECT_TRUE(std::isnan(ObservedOrder(3, 3, 3, 2)));
}

TEST(Refinement, ValuesThatGrowApartOrGoToAndFroDoNotSettle) {
  for (const auto& [coarse, middle, fine] :
       {std::tuple(1.0, 1.2, 1.6), {1.0, 1.1, 1.05}, {1.0, 1.1, 1.2}, {1.0, 1.0, 1.3}}) {
    const Refinement refinement = Refine(coarse, middle, fine, 2, 1e-13);
    EXPECT_FALSE(refinement.settles);
    EXPECT_EQ(refinement.limit, fine);
  }
}

TEST(Refinement, WhatIsNoNumberDoesNotSettle) {
  EXPECT_FALSE(Refine(NAN, 1, 1.1, 2, 1e-13).settles);
  EXPECT_FALSE(Refine(1, NAN, 1.1, 2, 1e-13).settles);
  EXPECT_FALSE(Refine(1, 1.1, NAN, 2, 1e-13).settles);
}

}  // namespace
}  // namespace contact::cli
