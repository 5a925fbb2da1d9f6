#include "simulation/motion/extrapolated_euler.h"

#include <gtest/gtest.h>

#include <cmath>

#include "testing/cases.h"

namespace contact {
namespace {

using Vector = Eigen::ArrayXd;

constexpr double kMass = 0.3, kStiffness = 5e7;

// A body against a wall, with a linear spring and damper: (M2) with n = 1, p = 0.
Scenario Damped() {
  Scenario s = testing::Collision(kMass, 2, kStiffness, 1, 1);
  s.contacts[0].damping = DampingLaw::kKelvinVoigt;
  return s;
}

// What a step needs of a scenario whose contacts are all in touch with this μ.
struct Touching {
  Touching(const Scenario& of, double mu) : scenario(of), equations(scenario) {
    for (int c = 0; c < equations.contacts(); ++c) {
      equations.active.push_back(equations.Activate(c, 0, mu, kNone));
    }
    equations.Prepare();
    euler.Prepare();
    y0.setZero(equations.size());
    slope0.resize(equations.size());
  }

  Vector Step(double h, int k) {
    equations(0, y0.data(), slope0.data());
    Vector y1;
    euler.Step(y0, slope0, 0, h, k, &y1);
    return y1;
  }

  const Scenario scenario;
  Equations equations;
  ExtrapolatedEuler euler{scenario, equations};
  Vector y0, slope0;
};

// δ and δ̇ of m δ̈ + c δ̇ + k δ = 0 with more than critical damping, from δ = 0.
struct Overdamped {
  Overdamped(double damping, double speed) {
    const double mean = damping / (2 * kMass);
    const double root = std::sqrt(mean * mean - kStiffness / kMass);
    fast = -mean - root;
    slow = kStiffness / kMass / fast;  // Their product, without cancellation.
    factor = speed / (slow - fast);
  }
  double Deformation(double t) const { return factor * (std::exp(slow * t) - std::exp(fast * t)); }
  double Rate(double t) const {
    return factor * (slow * std::exp(slow * t) - fast * std::exp(fast * t));
  }
  double fast = 0, slow = 0, factor = 0;
};

TEST(ExtrapolatedEuler, HasTheOrderThatWasAskedFor) {
  const double damping = 2 * std::sqrt(kMass * kStiffness) * 1.5;
  const Overdamped exact(damping, 2);
  for (const int k : {2, 3, 4, 5}) {
    const auto error = [&](double h) {
      Touching wall(Damped(), damping);
      wall.y0[1] = 2;
      return std::abs(wall.Step(h, k)[0] - exact.Deformation(h));
    };
    const double h = 0.05 / -exact.fast;
    EXPECT_NEAR(std::log2(error(h) / error(h / 2)), k + 1, 0.3) << k;
  }
}

// λ h is 3000 in this step, 500 times what the explicit method stands.
TEST(ExtrapolatedEuler, FollowsASlowMotionInStepsLongerThanItsDamping) {
  const double damping = 1e3 * std::sqrt(kMass * kStiffness);
  const Overdamped exact(damping, 2);
  Touching wall(Damped(), damping);
  const double start = 20 / -exact.fast;  // Of the fast part e⁻²⁰ is left.
  wall.y0[0] = exact.Deformation(start);
  wall.y0[1] = exact.Rate(start);
  const double h = 0.04 / -exact.slow;
  ASSERT_GT(-exact.fast * h, 3000);
  const Vector y1 = wall.Step(h, 7);
  EXPECT_NEAR(y1[0] / exact.Deformation(start + h), 1, 1e-10);
  EXPECT_NEAR(y1[1] / exact.Rate(start + h), 1, 1e-9);
  EXPECT_LT((h * wall.euler.error().head(1).abs() / y1[0]).maxCoeff(), 1e-8);
}

// Works are those that change the energy, and nothing changes the momentum.
TEST(ExtrapolatedEuler, KeepsTheBalancesOfARow) {
  Scenario row = testing::Chain({0.5, 0.4, 0.9, 0.2}, {1e8, 3e7, 2e8}, {1, 1, 1}, 0.2, 1);
  Touching touching(row, 1e12);
  touching.y0.head(4) << 3e-5, 2e-5, 1e-5, 0;
  touching.y0.segment(4, 4) << 2e-3, 1e-3, 3e-4, -1e-3;
  const double momentum = touching.equations.Momentum(touching.y0.data());
  const auto kinetic = [&](const Vector& y) {
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
      sum += 0.5 * row.bodies[static_cast<std::size_t>(i)].mass * y[4 + i] * y[4 + i];
    }
    return sum;
  };
  const Vector y1 = touching.Step(1e-6, 7);
  EXPECT_NEAR(touching.equations.Momentum(y1.data()) / momentum, 1, 1e-13);
  const double before = kinetic(touching.y0), lost = before - kinetic(y1);
  EXPECT_GT(lost, 5e-3 * before);
  EXPECT_NEAR(y1.tail(3).sum() / lost, 1, 1e-9);
}

// A support from end to end of a row of twelve is left out of the linear systems, not of the
// motion.
TEST(ExtrapolatedEuler, TakesAForceBetweenDistantBodiesExplicitly) {
  const std::size_t balls = 12;
  Scenario row =
      testing::Chain(std::vector<double>(balls, 0.5), std::vector<double>(balls - 1, 1e8),
                     std::vector<double>(balls - 1, 1), 0.2, 1);
  row.supports = {
      {.body = 0, .other = 11, .stiffness = 1e6, .damping = 1e3, .rest_position = -1.2}};
  const auto error = [&](double h) {
    Touching touching(row, 1e9);
    for (std::ptrdiff_t i = 0; i < 12; ++i) {
      touching.y0[i] = 1e-5 * static_cast<double>(12 - i);
      touching.y0[12 + i] = 1e-3 * std::sin(static_cast<double>(i));
    }
    return (touching.Step(h, 4) - touching.Step(h, 9)).head(24).abs().maxCoeff();
  };
  EXPECT_NEAR(std::log2(error(4e-6) / error(2e-6)), 5, 0.3);
}

TEST(ExtrapolatedEuler, InterpolatesToTheOrderOfItsNodes) {
  const double damping = 2 * std::sqrt(kMass * kStiffness) * 1.5;
  const Overdamped exact(damping, 2);
  const auto error = [&](double h) {
    Touching wall(Damped(), damping);
    wall.y0[1] = 2;
    const Vector y1 = wall.Step(h, 10);
    wall.euler.PrepareInterpolation(wall.y0, wall.slope0, 0, h, 10, y1);
    double largest = 0;
    Vector y;
    for (double theta = 0; theta <= 1; theta += 0.0625) {
      wall.euler.Interpolate(theta, &y);
      largest = std::max(largest, std::abs(y[1] - exact.Rate(theta * h)));
    }
    wall.euler.Interpolate(1, &y);
    EXPECT_TRUE((y == y1).all());
    return largest;
  };
  const double h = 1 / -exact.fast;
  EXPECT_NEAR(std::log2(error(h) / error(h / 2)), 8, 0.5);
}

}  // namespace
}  // namespace contact
