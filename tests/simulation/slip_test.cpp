// Supports whose spring slips at a largest force.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "simulation/motion/motion.h"
#include "testing/cases.h"

namespace contact {
namespace {

using testing::Record;
using testing::RunAndRecord;

constexpr double kMass = 0.5, kStiffness = 2e3, kForce = 30, kQuake = kForce / kStiffness;

// A mass that moves away from where its spring is slack.
Scenario OnSlippingSoil(double velocity, double end_time) {
  Scenario s;
  s.bodies = {{.name = "pile", .mass = kMass, .position = 7, .velocity = velocity}};
  s.supports = {{.body = 0, .stiffness = kStiffness, .rest_position = 7, .slip_force = kForce}};
  s.end_time = end_time;
  return s;
}

struct Place {
  double position, velocity;
};

// As a sine up to the quake, as a parabola until it stands, and then as a cosine about the slack
// position that has gone along.
Place ClosedForm(double v, double t) {
  const double w = std::sqrt(kStiffness / kMass), a = kForce / kMass;
  const double slips = std::asin(w * kQuake / v) / w;
  const double speed = std::sqrt(v * v - w * w * kQuake * kQuake);
  const double sticks = slips + speed / a;
  if (t < slips) return {v / w * std::sin(w * t), v * std::cos(w * t)};
  if (t < sticks) {
    const double since = t - slips;
    return {kQuake + (speed - a * since / 2) * since, speed - a * since};
  }
  const double slack = speed * speed / (2 * a);
  const double phase = w * (t - sticks);
  return {slack + kQuake * std::cos(phase), -w * kQuake * std::sin(phase)};
}

TEST(SlippingSpring, MovesAsASineAParabolaAndACosine) {
  for (const double v : {1.2, 3.0, -3.0, 40.0}) {
    for (const double end : {0.002, 0.01, 0.03, 0.1, 0.6, 1.5}) {
      const Record r = RunAndRecord(OnSlippingSoil(v, end));
      const double sign = v < 0 ? -1 : 1;
      const Place exact = ClosedForm(std::abs(v), end);
      EXPECT_NEAR(r.outcome.positions[0] - 7, sign * exact.position,
                  1e-9 * std::abs(exact.position) + 1e-14)
          << v << " " << end;
      EXPECT_NEAR(r.outcome.velocities[0], sign * exact.velocity, 1e-9 * std::abs(v))
          << v << " " << end;
      EXPECT_LE(r.outcome.energy_residual, 1e-10) << v << " " << end;
      EXPECT_LE(r.outcome.momentum_residual, 1e-10) << v << " " << end;
    }
  }
}

TEST(SlippingSpring, IsASpringBelowItsForce) {
  const double w = std::sqrt(kStiffness / kMass), v = 0.999 * w * kQuake;
  Scenario s = OnSlippingSoil(v, 0.5);
  const Record slips = RunAndRecord(s);
  s.supports[0].slip_force = std::numeric_limits<double>::infinity();
  EXPECT_EQ(slips.outcome.positions, RunAndRecord(s).outcome.positions);
}

// Steps of the classical method end on where it slips and sticks, so its order 4 is kept.
TEST(SlippingSpring, KeepsTheOrderOfConvergence) {
  const auto error = [](double step) {
    Scenario s = OnSlippingSoil(3, 0.1);
    s.solver.fixed_step = step;
    const Place exact = ClosedForm(3, 0.1);
    const Record r = RunAndRecord(s);
    return std::hypot(r.outcome.positions[0] - 7 - exact.position,
                      (r.outcome.velocities[0] - exact.velocity) / std::sqrt(kStiffness / kMass));
  };
  EXPECT_NEAR(std::log2(error(2e-3) / error(1e-3)), 4, 0.5);
  EXPECT_NEAR(std::log2(error(1e-3) / error(5e-4)), 4, 0.5);
}

// A sine that pushes more than the spring holds moves its slack position to and fro: the work of
// the load is what slips, but for what is stored.
TEST(SlippingSpring, DissipatesWhatALoadDoes) {
  Scenario s = OnSlippingSoil(0, 2);
  s.loads = {{.body = 0, .amplitude = 45, .angular_frequency = 20}};
  const Record r = RunAndRecord(s);
  EXPECT_EQ(r.outcome.end, Outcome::End::kFinished);
  EXPECT_LE(r.outcome.energy_residual, 1e-10);
  EXPECT_LE(r.outcome.momentum_residual, 1e-10);
  Scenario tight = s;
  tight.solver.relative_tolerance = 1e-13;
  EXPECT_NEAR(RunAndRecord(tight).outcome.positions[0], r.outcome.positions[0], 1e-9 * kQuake);
}

// A ram on a pile in soil at its side, its toe and between its halves.
Scenario Pile() {
  Scenario s = testing::TripleChain();
  s.supports = {{.body = 1, .stiffness = 1e6, .damping = 5, .rest_position = 0.1, .slip_force = 30},
                {.body = 2, .stiffness = 3e6, .rest_position = 0.2, .slip_force = 12},
                {.body = 2, .other = 1, .stiffness = 1e6, .rest_position = 0.1, .slip_force = 9}};
  s.end_time = 0.02;
  return s;
}

TEST(SlippingSpring, KeepsTheBalancesBesideContacts) {
  const Record r = RunAndRecord(Pile());
  EXPECT_TRUE(r.outcome.all_converged);
  EXPECT_GE(r.cycles.size(), 2u);
  EXPECT_LE(r.outcome.energy_residual, 1e-10);
  EXPECT_LE(r.outcome.momentum_residual, 1e-10);
  EXPECT_LE(r.outcome.worst_identity_residual, 1e-7);
  Scenario tight = Pile();
  tight.solver.relative_tolerance = 1e-13;
  tight.solver.restitution_tolerance = 1e-11;
  const Record exact = RunAndRecord(tight);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(r.outcome.velocities[i], exact.outcome.velocities[i], 2e-9) << i;
  }
}

TEST(FirstSlip, IsFoundWhereTheStretchPeaksBetweenTwoLooks) {
  // d = 1 − (θ − 0.57)²: more than 1 − 1e-6 only within 1e-3 of the peak.
  const auto end = [](double theta) {
    const double from = theta - 0.57;
    return DeformationPath::End{1 - from * from, -2 * from, -2};
  };
  const DeformationPath path(end(0), end(1));
  const auto slip = FirstSlip(path, 1 - 1e-6, 0);
  ASSERT_TRUE(slip.has_value());
  EXPECT_EQ(slip->kind, EventKind::kSlip);
  EXPECT_NEAR(slip->theta, 0.569, 1e-8);
  EXPECT_FALSE(FirstSlip(path, 1 + 1e-6, 0).has_value());
  const auto stick = FirstSlip(path, 0.5, 1);
  ASSERT_TRUE(stick.has_value());
  EXPECT_EQ(stick->kind, EventKind::kStick);
  EXPECT_NEAR(stick->theta, 0.57, 1e-12);
  EXPECT_FALSE(FirstSlip(DeformationPath(end(0), end(0.5)), 0.5, 1).has_value());
}

}  // namespace
}  // namespace contact
