#include "simulation/motion/contact_events.h"

#include <gtest/gtest.h>

namespace contact {
namespace {

// δ(θ) = a + bθ + cθ², which the path holds exactly.
DeformationPath Parabola(double a, double b, double c) {
  return {{a, b, 2 * c}, {a + b + c, b + 2 * c, 2 * c}};
}

TEST(DeformationPath, HoldsAQuinticExactly) {
  // δ = θ⁵ − 2θ³ + θ: value, slope and curvature at 0 are 0, 1, 0; at 1 they are 0, 0, 8.
  const DeformationPath path({0, 1, 0}, {0, 0, 8});
  for (const double t : {0.2, 0.5, 0.9}) {
    EXPECT_NEAR(path.Value(t), t * t * t * t * t - 2 * t * t * t + t, 1e-15);
    EXPECT_NEAR(path.Slope(t), 5 * t * t * t * t - 6 * t * t + 1, 1e-15);
  }
}

TEST(FirstEvent, FindsATouchWhereDeformationRisesThroughZero) {
  const auto event = FirstEvent(Phase::kOpen, Parabola(-0.25, 1, 0));
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, EventKind::kTouch);
  EXPECT_NEAR(event->theta, 0.25, 1e-15);
}

TEST(FirstEvent, FindsATouchThatIsOverBeforeTheStepEnds) {
  // Peak 1e-4 at θ = 0.5: between the eighths it is looked at there, and it stays for 0.02 only.
  const auto event = FirstEvent(Phase::kOpen, Parabola(1e-4 - 0.25, 1, -1));
  ASSERT_TRUE(event);
  EXPECT_NEAR(event->theta, 0.49, 1e-12);
  // Peak at θ = 0.55, off the eighths.
  const double peak = 1e-6;
  const auto graze = FirstEvent(Phase::kOpen, Parabola(peak - 0.3025, 1.1, -1));
  ASSERT_TRUE(graze);
  EXPECT_NEAR(graze->theta, 0.549, 1e-9);
  EXPECT_FALSE(FirstEvent(Phase::kOpen, Parabola(-1e-6 - 0.3025, 1.1, -1)));
}

TEST(FirstEvent, FindsNothingWhereBodiesPartOrStayApart) {
  EXPECT_FALSE(FirstEvent(Phase::kOpen, Parabola(0, -1, 0)));
  EXPECT_FALSE(FirstEvent(Phase::kOpen, Parabola(1e-20, -1, 0), 0, 1e-16));
  EXPECT_FALSE(FirstEvent(Phase::kOpen, Parabola(-1, 0.5, 0)));
  EXPECT_FALSE(FirstEvent(Phase::kOpen, Parabola(0, 0, 0)));
}

TEST(FirstEvent, ATouchFromRestBeginsAtOnce) {
  const auto event = FirstEvent(Phase::kOpen, Parabola(0, 0, 1));
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, EventKind::kRestTouch);
  EXPECT_EQ(event->theta, 0);
}

TEST(FirstEvent, ATouchThatPartsFirstBeginsWhereItComesBack) {
  const double noise = 0.01;
  const DeformationPath path({0, -0.005, -0.02}, {0.2, 1, 3});
  ASSERT_LT(path.Value(0.2), 0);
  const auto back = FirstEvent(Phase::kOpen, path, 0, noise);
  ASSERT_TRUE(back);
  EXPECT_GT(back->theta, 0.2);
  EXPECT_NEAR(path.Value(back->theta), 0, 1e-14);
  EXPECT_GT(path.Slope(back->theta), 0);
}

TEST(FirstEvent, RoundOffIsNoTouch) {
  EXPECT_FALSE(FirstEvent(Phase::kOpen, Parabola(-1e-20, 0, 3e-20), 0, 1e-16));
  const auto event = FirstEvent(Phase::kOpen, Parabola(-1e-20, 0, 1e-9), 0, 1e-16);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, EventKind::kRestTouch);
  EXPECT_EQ(event->theta, 0);
}

TEST(FirstEvent, CompressionEndsAtTheTurn) {
  const auto event = FirstEvent(Phase::kCompression, Parabola(0, 1, -1));
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, EventKind::kTurn);
  EXPECT_NEAR(event->theta, 0.5, 1e-15);
}

TEST(FirstEvent, RestitutionEndsInSeparationOrInRest) {
  const auto separation = FirstEvent(Phase::kRestitution, Parabola(0.5, -1, 0));
  ASSERT_TRUE(separation);
  EXPECT_EQ(separation->kind, EventKind::kSeparation);
  EXPECT_NEAR(separation->theta, 0.5, 1e-15);
  const auto rest = FirstEvent(Phase::kRestitution, Parabola(1, -1, 1));
  ASSERT_TRUE(rest);
  EXPECT_EQ(rest->kind, EventKind::kNonSeparation);
  EXPECT_NEAR(rest->theta, 0.5, 1e-15);
}

TEST(FirstEvent, ARestingContactOnlySeparates) {
  EXPECT_FALSE(FirstEvent(Phase::kResting, Parabola(1, -1, 1)));
  const auto event = FirstEvent(Phase::kResting, Parabola(0.5, -1, 0));
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, EventKind::kSeparation);
}

}  // namespace
}  // namespace contact
