#include "simulation/clusters/driven_paths.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "simulation/model/derived.h"

namespace contact {
namespace {

// A body that moves in three pieces, of polynomials and sines.
Scenario RandomlyDriven(unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  Scenario s;
  s.end_time = 1;
  double x = between(-1, 1), v = between(-1, 1), begin = 0;
  for (int i = 0; i < 3; ++i) {
    Drive piece{.body = 0, .begin = begin, .end = i < 2 ? begin + between(0.1, 0.5) : kNever};
    piece.acceleration = between(-5, 5);
    piece.jerk = between(-20, 20);
    piece.amplitude = between(-0.1, 0.1);
    piece.angular_frequency = between(1, 50);
    piece.phase = between(0, 6);
    const double sine = piece.amplitude * std::sin(piece.phase);
    const double slope = piece.amplitude * piece.angular_frequency * std::cos(piece.phase);
    piece.position = x - sine;
    piece.velocity = v - slope;
    const DrivenMotion there = MotionAt(piece, i < 2 ? piece.end : 1.0);
    x = there.position, v = there.velocity, begin = piece.end;
    s.drives.push_back(piece);
  }
  s.bodies = {{.name = "table", .position = MotionAt(s.drives[0], 0).position, .fixed = true}};
  return s;
}

const Drive& PieceOf(const Scenario& s, double t) {
  std::size_t i = 2;
  while (i > 0 && s.drives[i].begin > t) --i;
  return s.drives[i];
}

TEST(DrivenPaths, AreTheMotionSinceTheStart) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Scenario s = RandomlyDriven(seed);
    const DrivenPaths paths(s);
    ASSERT_TRUE(paths.Moves(0));
    EXPECT_FALSE(paths.Moves(kNone));
    for (double t = 0; t <= s.end_time; t += 0.01) {
      const DrivenMotion at = MotionAt(PieceOf(s, t), t);
      EXPECT_NEAR(paths.PlaceOf(0, t).u, at.position - s.bodies[0].position, 1e-13) << seed << t;
      EXPECT_EQ(paths.PlaceOf(0, t).v, at.velocity);
      EXPECT_EQ(paths.AccelerationOf(0, t), at.acceleration);
      EXPECT_EQ(paths.NextBreak(0, t), PieceOf(s, t).end);
    }
  }
}

TEST(DrivenPaths, StayWithinTheirBounds) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Scenario s = RandomlyDriven(seed);
    const DrivenPaths paths(s);
    for (double t = 0; t <= s.end_time; t += 0.01) {
      for (const double sign : {1.0, -1.0}) {
        EXPECT_LE(sign * paths.PlaceOf(0, t).u, paths.MostDisplacement(0, sign, 0.5 * t));
        const double begin = PieceOf(s, t).begin, from = begin + 0.5 * (t - begin);
        EXPECT_LE(sign * paths.AccelerationOf(0, t), paths.MostAcceleration(0, sign, from, t));
      }
    }
  }
}

TEST(DrivenPaths, BoundsOfOneThatSwingsAreTwiceItsAmplitude) {
  Scenario s;
  s.bodies = {{.name = "table", .fixed = true}};
  s.drives = {{.body = 0, .amplitude = 1e-3, .angular_frequency = 100}};
  s.end_time = 10;
  EXPECT_DOUBLE_EQ(DrivenPaths(s).MostDisplacement(0, 1, 5), 2e-3);
  EXPECT_DOUBLE_EQ(DrivenPaths(s).MostDisplacement(0, -1, 5), 2e-3);
}

}  // namespace
}  // namespace contact
