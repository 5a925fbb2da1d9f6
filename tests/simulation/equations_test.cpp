#include "simulation/motion/equations.h"

#include <gtest/gtest.h>

#include <random>

#include "testing/cases.h"

namespace contact {
namespace {

// Three balls, a wall, a support between bodies and one to the ground: every kind of term.
Scenario Mixed() {
  Scenario s = testing::Chain({0.5, 0.8, 0.3}, {1e8, 3e7}, {0.8, 0.7}, 0.2, 1);
  s.contacts.push_back({.name = "wall",
                        .right = 0,
                        .wall_position = -0.05,
                        .stiffness = 2e7,
                        .exponent = 1.2,
                        .restitution = 0.5});
  s.supports = {{.body = 0, .stiffness = 1e5, .damping = 30, .rest_position = 0.01},
                {.body = 2, .other = 1, .stiffness = 2e5, .damping = 20, .rest_position = 0.1}};
  s.loads = {{.body = 1, .constant = 40, .amplitude = 9, .angular_frequency = 70, .phase = 0.4}};
  return s;
}

struct MixedPoint {
  Scenario scenario = Mixed();
  Equations equations{scenario};
  Eigen::ArrayXd y;

  MixedPoint() {
    for (int c = 0; c < 3; ++c) {
      equations.active.push_back(equations.Activate(c, 0, 1e7 * (c + 1), c));
    }
    equations.columns = 3;
    y = Eigen::ArrayXd::Zero(equations.size());
    y.head(6) << 1e-5, -2e-5, -9e-5, 0.1, -0.05, 0.02;
    y[0] = -3e-6;  // Into the wall too.
    std::mt19937 random(7);
    std::uniform_real_distribution<double> tangent(-1e-12, 1e-12);
    for (auto i = equations.tangent(0); i < y.size(); ++i) y[i] = tangent(random);
  }

  Eigen::ArrayXd Slope() const {
    Eigen::ArrayXd dy(y.size());
    equations(0.3, y.data(), dy.data());
    return dy;
  }
};

// A sensitivity column is the derivative of the slope along (∂y/∂μ, 1 for its own μ).
TEST(Equations, SensitivityColumnsAreDirectionalDerivatives) {
  MixedPoint s;
  const auto& equations = s.equations;
  // u, v and W, or their derivatives.
  const auto block = [&](const Eigen::ArrayXd& all, std::ptrdiff_t motion, std::ptrdiff_t work) {
    Eigen::ArrayXd part(6 + 3);
    part << all.segment(motion, 6), all.segment(work, 3);
    return part;
  };
  const Eigen::ArrayXd dy = s.Slope();
  for (int column = 0; column < 3; ++column) {
    const double step = 1e3;  // Of μ; the tangents are made for it.
    MixedPoint plus, minus;
    plus.y.head(6) += step * s.y.segment(equations.tangent(column), 6);
    minus.y.head(6) -= step * s.y.segment(equations.tangent(column), 6);
    plus.equations.active[static_cast<std::size_t>(column)].mu += step;
    minus.equations.active[static_cast<std::size_t>(column)].mu -= step;
    const Eigen::ArrayXd difference =
        block(plus.Slope() - minus.Slope(), 0, equations.work(0)) / (2 * step);
    const Eigen::ArrayXd analytic =
        block(dy, equations.tangent(column), equations.work_tangent(0, column));
    for (int i = 0; i < 9; ++i) {
      EXPECT_NEAR(analytic[i], difference[i], 1e-6 * (difference.abs().maxCoeff() + 1e-12))
          << "row " << i << ", column " << column;
    }
  }
}

// The shorter way for a few contacts gives the same slopes, to the last bit.
TEST(Equations, FewContactsAreComputedAsMany) {
  for (const bool recording : {false, true}) {
    for (const int contacts : {1, 2}) {
      const Scenario s = testing::TripleChain();
      Equations equations(s);
      for (int c = 0; c < contacts; ++c) {
        equations.active.push_back(equations.Activate(c, 1e-6, 2e8, c));
      }
      equations.columns = contacts;
      equations.recording = recording;
      Eigen::ArrayXd y = Eigen::ArrayXd::LinSpaced(equations.size(), -1e-12, 3e-12);
      y.head(6) << 3e-5, 1e-5, -1e-5, 0.1, 0.02, -0.03;
      Eigen::ArrayXd many(y.size()), few(y.size());
      equations(0, y.data(), many.data(), 0.7);
      equations.Prepare();
      equations(0, y.data(), few.data(), 0.7);
      for (Eigen::Index i = 0; i < y.size(); ++i) EXPECT_EQ(few[i], many[i]) << i;
    }
  }
}

TEST(Equations, InternalForcesKeepTheMomentum) {
  Scenario s = testing::TripleChain();
  Equations equations(s);
  equations.active = {equations.Activate(0, 0, 1e8, kNone), equations.Activate(1, 0, 2e8, kNone)};
  Eigen::ArrayXd y = Eigen::ArrayXd::Zero(equations.size()), dy(equations.size());
  y.head(6) << 3e-5, 1e-5, -1e-5, 0.1, 0.02, -0.03;
  equations(0, y.data(), dy.data());
  EXPECT_NEAR(dy.segment(3, 3).sum(), 0, 1e-12 * dy.segment(3, 3).abs().maxCoeff());
}

// F_e = m_e (F_i/m_i − F_j/m_j) with all other forces; here those of the second contact and a load.
TEST(Equations, ExternalForceIsThatOfTheOtherForces) {
  Scenario s = testing::Chain({0.5, 0.8, 0.3}, {1e8, 3e7}, {0.8, 0.7}, 0.2, 1);
  s.loads = {{.body = 0, .constant = 40}};
  Equations equations(s);
  equations.recording = true;
  equations.active = {equations.Activate(0, 0, 1e8, kNone), equations.Activate(1, 0, 2e8, kNone)};
  Eigen::ArrayXd y = Eigen::ArrayXd::Zero(equations.size()), dy(equations.size());
  y.head(6) << 3e-5, 1e-5, -1e-5, 0.1, 0.02, -0.03;
  equations(0, y.data(), dy.data());
  const double other = Power(2e-5, 1.5).value * (3e7 + 2e8 * 0.05);
  const double effective = 1 / (1 / 0.5 + 1 / 0.8);
  const double external = effective * (40 / 0.5 + other / 0.8);
  EXPECT_NEAR(dy[equations.external_work(0)], external * 0.08, 1e-12 * external);
}

TEST(Equations, AWallHasInfiniteMass) {
  const Scenario s = Mixed();
  EXPECT_DOUBLE_EQ(Equations(s).effective_mass(2), 0.5);
  EXPECT_DOUBLE_EQ(Equations(s).effective_mass(0), 1 / (1 / 0.5 + 1 / 0.8));
}

TEST(Power, IsZeroWithoutOverlapAndSmoothThere) {
  EXPECT_EQ(Power(-1e-3, 1.5).value, 0);
  EXPECT_EQ(Power(0, 1).value, 0);
  EXPECT_DOUBLE_EQ(Power(1e-4, 1.5).value, 1e-6);
  EXPECT_DOUBLE_EQ(Power(1e-4, 2).slope, 2e-4);
}

}  // namespace
}  // namespace contact
