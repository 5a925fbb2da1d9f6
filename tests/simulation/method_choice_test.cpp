#include "simulation/motion/method_choice.h"

#include <gtest/gtest.h>

namespace contact {
namespace {

// How many explicit steps of this λ h it takes until the implicit method is chosen; 0: too many.
int StepsToImplicit(MethodChoice& choice, double damping) {
  for (int i = 1; i <= 1000; ++i) {
    choice.AfterExplicit(damping);
    if (choice.implicit()) return i;
  }
  return 0;
}

TEST(MethodChoice, BeginsWithTheExplicitMethod) {
  MethodChoice choice;
  EXPECT_FALSE(choice.implicit());
  StepsToImplicit(choice, 5);
  EXPECT_TRUE(choice.implicit());
  choice.Begin();
  EXPECT_FALSE(choice.implicit());
}

TEST(MethodChoice, IsImplicitAfterDampingHasKeptStepsShortInARow) {
  MethodChoice choice;
  EXPECT_EQ(StepsToImplicit(choice, 5), 10);
  choice.Begin();
  for (int i = 0; i < 9; ++i) choice.AfterExplicit(5);
  choice.AfterExplicit(0.1);
  EXPECT_EQ(StepsToImplicit(choice, 5), 10);
}

TEST(MethodChoice, AnUndampedMotionStaysExplicit) {
  MethodChoice choice;
  EXPECT_EQ(StepsToImplicit(choice, 0.9), 0);
}

TEST(MethodChoice, ATrialHasTimeToEndWhatExplicitStepsLeave) {
  MethodChoice choice;
  StepsToImplicit(choice, 1.1);
  for (int i = 0; i < 6; ++i) {
    choice.AfterImplicit(1.5);
    EXPECT_TRUE(choice.implicit()) << i;
  }
  choice.AfterImplicit(1.5);
  EXPECT_FALSE(choice.implicit());
}

TEST(MethodChoice, ImplicitStepsGoOnWhileTheyAreLong) {
  MethodChoice choice;
  StepsToImplicit(choice, 5);
  for (int i = 0; i < 100; ++i) {
    choice.AfterImplicit(30);
    EXPECT_TRUE(choice.implicit());
  }
  choice.AfterImplicit(4);
  EXPECT_FALSE(choice.implicit());
  EXPECT_EQ(StepsToImplicit(choice, 5), 10);  // They were worth it.
}

TEST(MethodChoice, WhatWasNotWorthItIsTriedLessAndLessOften) {
  MethodChoice choice;
  int before = 0;
  for (const int expected : {10, 20, 40, 80, 160, 160}) {
    EXPECT_EQ(StepsToImplicit(choice, 5), expected);
    for (int i = 0; i < 7; ++i) choice.AfterImplicit(before % 2 == 0 ? 4 : 0.1);
    ++before;
  }
}

}  // namespace
}  // namespace contact
