#include "simulation/motion/contact_events.h"

#include <gtest/gtest.h>

#include <random>

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

TEST(FirstEvent, ATouchThatPartsForAMomentBeginsWhereItComesBack) {
  for (const double moment : {0.1, 1e-3, 1e-6}) {  // δ = θ² (θ − moment): loads part, then press.
    SCOPED_TRACE(moment);
    const DeformationPath path({0, 0, -2 * moment}, {1 - moment, 3 - 2 * moment, 6 - 2 * moment});
    const auto back = FirstEvent(Phase::kOpen, path);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->theta, moment, 1e-6 * moment);
  }
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

// Paths of all kinds, many of which cross, graze or stay.
class RandomPaths {
 public:
  DeformationPath Next() { return {End(), End()}; }

 private:
  DeformationPath::End End() { return {of_(engine_), 4 * of_(engine_), 20 * of_(engine_)}; }

  std::mt19937 engine_{11};
  std::uniform_real_distribution<double> of_{-1, 1};
};

TEST(DeformationPath, MeetsItsEnds) {
  RandomPaths paths;
  for (int i = 0; i < 1000; ++i) {
    const DeformationPath path = paths.Next();
    EXPECT_EQ(path.Value(0), path.start.value);
    EXPECT_EQ(path.Slope(0), path.start.slope);
    EXPECT_NEAR(path.Value(1), path.end.value, 1e-13);
    EXPECT_NEAR(path.Slope(1), path.end.slope, 1e-12);
    const double h = 1e-5;
    EXPECT_NEAR((path.Slope(1) - path.Slope(1 - h)) / h, path.end.curvature, 0.02);
  }
}

TEST(FirstEvent, LiesWhereItsKindSays) {
  RandomPaths paths;
  int events = 0;
  for (int i = 0; i < 3000; ++i) {
    const DeformationPath path = paths.Next();
    for (const Phase phase :
         {Phase::kOpen, Phase::kCompression, Phase::kRestitution, Phase::kResting}) {
      const auto event = FirstEvent(phase, path);
      if (!event) continue;
      ASSERT_TRUE(event->theta >= 0 && event->theta <= 1) << i;
      if (event->theta == 0) continue;  // The phase is over already.
      ++events;
      const bool turns =
          event->kind == EventKind::kTurn || event->kind == EventKind::kNonSeparation;
      EXPECT_NEAR(turns ? path.Slope(event->theta) : path.Value(event->theta), 0, 1e-11) << i;
    }
  }
  EXPECT_GT(events, 3000);
}

// A step passes over what is plain. Of cubics, whose δ̇ has one extremum at most, it misses nothing.
TEST(DeformationPath, APlainCubicHasNoEvent) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> of(-1, 1);
  int plain = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double a = of(engine), b = of(engine), c = 2 * of(engine), d = 2 * of(engine);
    const DeformationPath::End start{a, b, 2 * c};
    const DeformationPath::End end{a + b + c + d, b + 2 * c + 3 * d, 2 * c + 6 * d};
    for (const Phase phase : {Phase::kOpen, Phase::kCompression, Phase::kRestitution}) {
      const double sign = phase == Phase::kRestitution ? -1 : 1;
      const bool in_phase = phase == Phase::kOpen ? a < 0 : a > 0 && sign * b > 0;
      if (!in_phase || !DeformationPath::IsPlain(phase, start, end)) continue;
      ++plain;
      EXPECT_FALSE(FirstEvent(phase, {start, end})) << i << ' ' << static_cast<int>(phase);
    }
  }
  EXPECT_GT(plain, 2000);
}

// δ̇ falls through 0 at θ = 0.2 and 0.8, and rises through 0 at 0.5.
TEST(FirstEvent, OnlyLooksAtWhatIsLeft) {
  const auto slope = [](double t) { return -(t - 0.2) * (t - 0.5) * (t - 0.8); };
  const auto curvature = [&](double t) { return (slope(t + 1e-6) - slope(t - 1e-6)) / 2e-6; };
  // δ is 1 at both ends, for δ̇ is odd about θ = 0.5.
  const DeformationPath path({1, slope(0), curvature(0)}, {1, slope(1), curvature(1)});
  const auto first = FirstEvent(Phase::kCompression, path);
  ASSERT_TRUE(first);
  EXPECT_NEAR(first->theta, 0.2, 1e-6);
  const auto later = FirstEvent(Phase::kCompression, path, 0.55);
  ASSERT_TRUE(later);
  EXPECT_NEAR(later->theta, 0.8, 1e-6);
  EXPECT_FALSE(FirstEvent(Phase::kRestitution, path, 0.85));
}

}  // namespace
}  // namespace contact
