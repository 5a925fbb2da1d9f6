// The closed forms of bodies that nothing touches, and the book of those bound together.
#include "simulation/clusters/flight.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulation/clusters/blocks.h"

namespace contact {
namespace {

// At the time told the gap is closed, and at no instant before.
TEST(Flight, FacesTouchWhereTheirGapCloses) {
  for (const double gap : {1e-12, 1e-3, 2.0}) {
    for (const double speed : {-3.0, -1e-6, 0.0, 1e-9, 0.5}) {
      for (const double acceleration : {-9.81, -1e-3, 0.0, 1e-3, 9.81}) {
        const double time = TimeToTouch(gap, speed, acceleration);
        const auto left = [&](double t) { return gap - t * (speed + 0.5 * acceleration * t); };
        if (time == kNever) {
          for (double t = 1e-6; t < 1e6; t *= 1.3) EXPECT_GT(left(t), 0) << gap << " " << speed;
          continue;
        }
        EXPECT_NEAR(left(time), 0, 1e-14 * (gap + std::abs(speed) * time));
        for (int i = 0; i < 100; ++i) EXPECT_GT(left(time * i / 100), 0);
      }
    }
  }
}

TEST(Flight, FacesInTouchWaitUntilTheyArePressed) {
  EXPECT_EQ(TimeToTouch(0, 1, -1), 0);         // They close.
  EXPECT_EQ(TimeToTouch(0, 0, 1), 0);          // Pressed at rest.
  EXPECT_EQ(TimeToTouch(0, 0, 0), kNever);     // At rest beside each other.
  EXPECT_EQ(TimeToTouch(0, -1, 0), kNever);    // They part.
  EXPECT_DOUBLE_EQ(TimeToTouch(0, -2, 4), 1);  // They part, and fall back.
}

TEST(Flight, ABodyKeepsItsEnergyUnderAConstantForce) {
  const Flight flight{.time = 2, .start = {.u = 0.1, .v = 3}, .acceleration = -9.81};
  for (const double t : {2.0, 2.3, 7.0}) {
    const Place at = flight.At(t);
    EXPECT_NEAR(0.5 * at.v * at.v + 9.81 * at.u, 0.5 * 9 + 9.81 * 0.1, 1e-10);
  }
}

TEST(Blocks, BindAllThatIsBoundToWhatTheyBind) {
  Blocks blocks;
  blocks.of.resize(6);
  EXPECT_EQ(blocks.With(3), std::vector<int>{3});
  blocks.Bind({0, 3});
  blocks.Bind({1, 5});
  EXPECT_TRUE(blocks.With(2).size() == 1);
  blocks.Bind({3, 5});
  EXPECT_EQ(blocks.With(0), (std::vector<int>{0, 1, 3, 5}));
  EXPECT_EQ(blocks.All().size(), 1U);
}

}  // namespace
}  // namespace contact
