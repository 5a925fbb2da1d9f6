// Supports whose spring is a polynomial, (M4).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simulation/forecast/first_meeting.h"
#include "simulation/proof/independent.h"
#include "simulation/statics/equilibrium.h"
#include "testing/cases.h"

namespace contact {
namespace {

using testing::Record;
using testing::RunAndRecord;

// A mass of 1 kg that is let go at `stretch` from a spring with −d − k₃ d³, or moves there with a
// velocity.
Scenario CubicSpring(double k3, double stretch, double velocity = 0) {
  Scenario s;
  s.bodies = {{.name = "mass", .mass = 1, .position = 3 + stretch, .velocity = velocity}};
  s.supports = {{.body = 0, .stiffness = 1, .rest_position = 3, .higher = {0, k3}}};
  return s;
}

// d̈ = −d − k₃ d³ from d = a at rest: 4 K(κ)/√(1 + k₃ a²), κ² = k₃ a²/(2 (1 + k₃ a²)), k₃ > 0.
double HardeningPeriod(double k3, double a) {
  const double all = 1 + k3 * a * a;
  return 4 * std::comp_ellint_1(std::sqrt(k3 * a * a / (2 * all))) / std::sqrt(all);
}

// The same of k₃ = −s < 0: 4 K(κ)/√(1 − s a²/2), κ² = (s a²/2)/(1 − s a²/2), s a² < 1.
double SofteningPeriod(double s, double a) {
  const double half = s * a * a / 2;
  return 4 * std::comp_ellint_1(std::sqrt(half / (1 - half))) / std::sqrt(1 - half);
}

TEST(PolynomialSpring, SwingsWithThePeriodOfTheEllipticIntegral) {
  const auto expect = [](double k3, double a, double period) {
    Scenario s = CubicSpring(k3, a);
    s.end_time = 10 * period;
    const Record r = RunAndRecord(s);
    EXPECT_NEAR(r.outcome.positions[0], 3 + a, 1e-9 * a) << k3 << " " << a;
    const double fastest = a * std::sqrt(1 + k3 * a * a / 2);
    EXPECT_NEAR(r.outcome.velocities[0], 0, 1e-9 * fastest) << k3 << " " << a;
    EXPECT_LE(r.outcome.energy_residual, 1e-10) << k3 << " " << a;
    EXPECT_LE(r.outcome.momentum_residual, 1e-10) << k3 << " " << a;
    s.end_time = period / 2;
    EXPECT_NEAR(RunAndRecord(s).outcome.positions[0], 3 - a, 1e-9 * a) << k3 << " " << a;
  };
  for (const double a : {0.1, 1.0, 10.0}) expect(1, a, HardeningPeriod(1, a));
  for (const double a : {0.1, 0.7, 0.9}) expect(-1, a, SofteningPeriod(1, a));
}

// d̈ = −d³ from rest at a takes 4 K(1/√2)/a.
TEST(PolynomialSpring, MayHaveNoLinearPart) {
  Scenario s = CubicSpring(1, 2);
  s.supports[0].stiffness = 0;
  s.end_time = 4 * std::comp_ellint_1(std::sqrt(0.5)) / 2;
  EXPECT_NEAR(RunAndRecord(s).outcome.positions[0], 5, 2e-9);
  s = CubicSpring(1, 0, 1);  // Begins where nothing pulls.
  s.supports[0].stiffness = 0;
  s.end_time = 4 * std::comp_ellint_1(std::sqrt(0.5)) / std::pow(2, 0.25);
  EXPECT_NEAR(RunAndRecord(s).outcome.velocities[0], 1, 1e-9);
}

// Beyond the top of its potential a softening spring pushes, and the mass never returns.
TEST(PolynomialSpring, LetsGoBeyondTheTopOfItsPotential) {
  Scenario s = CubicSpring(-1, 0, 0.72);  // ½ v² > ¼, that of the top at d = 1.
  s.end_time = 3;
  const Record r = RunAndRecord(s);
  EXPECT_GT(r.outcome.positions[0], 4);
  const double d = r.outcome.positions[0] - 3, v = r.outcome.velocities[0];
  EXPECT_NEAR(v * v / 2 + d * d / 2 - std::pow(d, 4) / 4, 0.72 * 0.72 / 2, 1e-9);
  s.end_time = 30;  // It takes a finite time to infinity.
  EXPECT_EQ(RunAndRecord(s).outcome.end, Outcome::End::kNumeric);
}

// Forces between two bodies, beside contacts: an integration that shares no code agrees.
TEST(PolynomialSpring, AgreesWithAnIndependentIntegrationBesideContacts) {
  Scenario s = testing::TripleChain();
  s.supports = {
      {.body = 2, .stiffness = 1e5, .damping = 20, .rest_position = 0.2, .higher = {3e8, 4e12}},
      {.body = 1, .other = 0, .rest_position = 0.1, .higher = {-2e9, 5e13}}};
  s.end_time = 8e-3;
  const Record r = RunAndRecord(s);
  EXPECT_LE(r.outcome.energy_residual, 1e-10);
  EXPECT_TRUE(r.outcome.all_converged);
  const testing::Disagreement other = testing::CompareWithIndependent(s, r);
  EXPECT_EQ(other.checked_until, s.end_time);
  EXPECT_LT(other.worst, 1e-8) << other.where;
}

TEST(PolynomialSpring, StandsWhereItsForceHoldsTheLoad) {
  Scenario s = CubicSpring(1, 0);
  s.loads = {{.body = 0, .constant = 10}};  // d + d³ = 10 at 2.
  Equilibrium found = FindEquilibrium(s);
  EXPECT_TRUE(found.unheld.empty());
  EXPECT_NEAR(found.positions[0], 5, 1e-12);
  s.loads[0].constant = -10;
  EXPECT_NEAR(FindEquilibrium(s).positions[0], 1, 1e-12);
}

// d − 0.1 d³ is 1.217 at most, at d = 1.826.
TEST(PolynomialSpring, StandsOnItsOwnSideOfTheTopOrNowhere) {
  Scenario s = CubicSpring(-0.1, 0);
  s.loads = {{.body = 0, .constant = 1}};
  const Equilibrium held = FindEquilibrium(s);
  ASSERT_TRUE(held.unheld.empty());
  const double d = held.positions[0] - 3;
  EXPECT_NEAR(d - 0.1 * d * d * d, 1, 1e-12);
  EXPECT_LT(d, 1.826);
  s.loads[0].constant = 1.3;
  EXPECT_FALSE(FindEquilibrium(s).unheld.empty());
}

TEST(PolynomialSpring, LeavesTheFirstMeetingUnknown) {
  Scenario s = testing::SpringWall();
  EXPECT_TRUE(ForecastFirstMeetings(s)[0].has_value());
  s.supports[0].higher = {1e9};
  EXPECT_FALSE(ForecastFirstMeetings(s)[0].has_value());
}

// A spring that is held by its stiffness about a load swings about it, in a step of 1/ω at most.
TEST(PolynomialSpring, SwingsAboutALoadAsItsSlopeThereSays) {
  Scenario s = CubicSpring(1, 2 + 1e-5);
  s.loads = {{.body = 0, .constant = 10}};
  s.end_time = 2 * std::numbers::pi / std::sqrt(1 + 3 * 4);
  EXPECT_NEAR(RunAndRecord(s).outcome.positions[0], 5 + 1e-5, 1e-14);
}

}  // namespace
}  // namespace contact
