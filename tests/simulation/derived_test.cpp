// What follows from a scenario at once.
#include "simulation/model/derived.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulation/motion/equations.h"
#include "testing/cases.h"

namespace contact {
namespace {

TEST(InitialGap, IsTheDistanceOfTheSurfaces) {
  Scenario s = testing::Chain({1, 1}, {1e8}, {0.5}, 0, 1);
  s.bodies[1].position += 0.25;
  s.contacts.push_back({.name = "right", .left = 1, .wall_position = 0.6, .stiffness = 1});
  s.contacts.push_back({.name = "left", .right = 0, .wall_position = -0.04, .stiffness = 1});
  EXPECT_DOUBLE_EQ(InitialGap(s, s.contacts[0]), 0.25);
  EXPECT_NEAR(InitialGap(s, s.contacts[1]), 0.2, 1e-16);
  EXPECT_NEAR(InitialGap(s, s.contacts[2]), -0.01, 1e-16);  // In overlap.
}

// 0.1 + 0.2 is not 0.3 in binary; touching is meant.
TEST(InitialGap, OfDecimalsThatTouchIsZero) {
  for (int i = 1; i < 200; ++i) {
    const double radius = i * 0.001, position = i * 0.37;
    Scenario s;
    s.bodies = {{.name = "A", .radius = radius, .position = position},
                {.name = "B", .radius = 0.3, .position = position + radius + 0.3}};
    s.contacts = {{.name = "AB", .left = 0, .right = 1}};
    EXPECT_EQ(InitialGap(s, s.contacts[0]), 0) << i;
    s.bodies[1].position *= 1 + 1e-10;
    EXPECT_GT(InitialGap(s, s.contacts[0]), 0) << i;
  }
}

TEST(ForcingRate, IsThatOfTheFastest) {
  Scenario s = testing::Chain({0.5, 0.25}, {1e8}, {0.5}, 0, 1);
  EXPECT_EQ(ForcingRate(s, s.loads), 0);
  s.loads = {{.body = 0, .constant = 1e9, .angular_frequency = 1e6},  // Without amplitude.
             {.body = 0, .amplitude = 1, .angular_frequency = 30},
             {.body = 1, .amplitude = 1e-3, .angular_frequency = 20}};
  EXPECT_EQ(ForcingRate(s, s.loads), 30);
  s.supports = {{.body = 0, .stiffness = 800}};
  EXPECT_DOUBLE_EQ(ForcingRate(s, s.loads), std::sqrt(800 / 0.5));
  s.supports[0].other = 1;  // 1/m adds up.
  EXPECT_DOUBLE_EQ(ForcingRate(s, s.loads), std::sqrt(800 * (1 / 0.5 + 1 / 0.25)));
  s.bodies[1].fixed = true;  // As the ground.
  EXPECT_DOUBLE_EQ(ForcingRate(s, s.loads), std::sqrt(800 / 0.5));
  s.supports[0].damping = 25;
  EXPECT_DOUBLE_EQ(ForcingRate(s, s.loads), 25 / 0.5);
}

TEST(ForcingRate, OfTheEquationsIsThatOfTheLoadsThatAct) {
  Scenario s = testing::Chain({0.5, 0.5}, {1e8}, {0.5}, 0, 1);
  s.loads = {{.body = 0, .begin = 1, .end = 2, .amplitude = 1, .angular_frequency = 30}};
  Equations equations(s);
  EXPECT_TRUE(std::isinf(equations.ForcingTime()));
  equations.SelectLoads(1);
  EXPECT_DOUBLE_EQ(equations.ForcingTime(), 1.0 / 30);
  equations.SelectLoads(2);
  EXPECT_TRUE(std::isinf(equations.ForcingTime()));
}

}  // namespace
}  // namespace contact
