#include "simulation/episode/quasi_newton.h"

#include <gtest/gtest.h>

#include <cmath>

namespace contact {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

const QuasiNewton::Cycles kTwo = {{0, 1}, {1, 1}};

// Two equations that are coupled and bend; their root is (1, 2).
Vector2d Residuals(const VectorXd& mu) {
  return {mu[0] * mu[0] + 0.3 * mu[1] - 1.6, 0.2 * mu[0] * mu[1] + mu[1] - 2.4};
}

MatrixXd ByLogarithm(const VectorXd& mu) {
  MatrixXd jacobian(2, 2);
  jacobian << 2 * mu[0], 0.3, 0.2 * mu[1], 0.2 * mu[0] + 1;
  return jacobian * mu.asDiagonal();
}

VectorXd Moved(const VectorXd& mu, const VectorXd& relative) {
  return mu.array() * (1 + relative.array());
}

TEST(QuasiNewton, SolvesLinearEquationsInOneStep) {
  MatrixXd a(2, 2);
  a << 3, 1, -1, 2;
  const Vector2d root(5, 0.5), mu(1, 4);
  QuasiNewton newton;
  newton.Set(kTwo, mu, a * (mu - root), a * mu.asDiagonal());
  EXPECT_LT((Moved(mu, newton.Step()) - root).norm(), 1e-14);
}

TEST(QuasiNewton, KnowsTheSlopeAtTheEndOfAParabola) {
  const auto r = [](double mu) { return VectorXd::Constant(1, 3 * mu * mu - mu - 7); };
  QuasiNewton newton;
  newton.Set({{0, 1}}, VectorXd::Constant(1, 2), r(2), MatrixXd::Constant(1, 1, 2 * (6 * 2 - 1)));
  newton.Update(VectorXd::Constant(1, 1.5), r(1.5));
  const double slope = 6 * 1.5 - 1;
  EXPECT_NEAR(newton.Step()[0], -r(1.5)[0] / slope / 1.5, 1e-14);
}

TEST(QuasiNewton, ConvergesFasterThanByOneJacobianAlone) {
  VectorXd mu = Vector2d(1.3, 1.6), chord = mu;
  QuasiNewton newton;
  newton.Set(kTwo, mu, Residuals(mu), ByLogarithm(mu));
  const MatrixXd inverse = (ByLogarithm(mu) * mu.cwiseInverse().asDiagonal()).inverse();
  for (int i = 0; i < 5; ++i) {
    mu = Moved(mu, newton.Step());
    newton.Update(mu, Residuals(mu));
    chord -= inverse * Residuals(chord);
  }
  EXPECT_LT(Residuals(mu).norm(), 1e-8);
  EXPECT_LT(Residuals(mu).norm(), 1e-3 * Residuals(chord).norm());
}

TEST(QuasiNewton, IsOfTheCyclesThatItWasTakenOf) {
  QuasiNewton newton;
  EXPECT_FALSE(newton.IsOf(kTwo));
  newton.Set(kTwo, Vector2d(1, 1), Vector2d(1, 1), MatrixXd::Identity(2, 2));
  EXPECT_TRUE(newton.IsOf(kTwo));
  EXPECT_FALSE(newton.IsOf({{0, 1}, {1, 2}}));
  newton.Forget();
  EXPECT_FALSE(newton.IsOf(kTwo));
}

// A μ of 0 has no relative change; its own equation takes no part.
TEST(QuasiNewton, StaysFiniteAtZero) {
  QuasiNewton newton;
  newton.Set(kTwo, Vector2d(0, 1), Vector2d(0.1, 0.2), MatrixXd::Identity(2, 2));
  EXPECT_TRUE(newton.Step().allFinite());
}

}  // namespace
}  // namespace contact
