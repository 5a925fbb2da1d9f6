// Closed forms of the laws, against independent ones.
#include "simulation/laws/isolated_collision.h"

#include <gtest/gtest.h>

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/special_functions/lambert_w.hpp>
#include <cmath>

#include "simulation/laws/power.h"

namespace contact {
namespace {

TEST(DeliveredRestitution, IsTheBranchOfLambertsFunction) {
  for (double alpha = 0.05; alpha < 20; alpha *= 1.3) {
    const double w = boost::math::lambert_w0(-(1 + alpha) * std::exp(-(1 + alpha)));
    EXPECT_NEAR(DeliveredRestitution(alpha), (1 + w) / alpha, 1e-12) << alpha;
  }
}

TEST(DeliveredRestitution, FallsFromOneToNothing) {
  EXPECT_EQ(DeliveredRestitution(0), 1);
  double before = 1;
  for (double alpha = 1e-9; alpha < 1e6; alpha *= 1.1) {
    const double delivered = DeliveredRestitution(alpha);
    EXPECT_LT(delivered, before) << alpha;
    EXPECT_GT(delivered, 0) << alpha;
    EXPECT_LT(alpha * delivered, 1 + 1e-15) << alpha;  // So it never pulls.
    before = delivered;
  }
  EXPECT_LT(before, 1e-5);
}

// α = 3/2 (1 − ε) + …: what Hunt and Crossley took for the whole.
TEST(ExactCoefficient, BeginsAsHuntAndCrossleySay) {
  for (const double loss : {1e-2, 1e-4, 1e-6}) {
    EXPECT_NEAR(ExactCoefficient(1 - loss) / (1.5 * loss), 1, 2 * loss);
  }
}

// v dv/dδ = −(k/m) δⁿ (1 + α v/v₀): separated and integrated over v from v₀ to 0.
TEST(MaximumDeformation, IsTheIntegralOfTheEquationOfMotion) {
  boost::math::quadrature::tanh_sinh<double> integrator;
  for (const double n : {1.0, 1.5, 3.0}) {
    for (const double alpha : {0.0, 0.01, 0.5, 4.0}) {
      const double m = 0.3, v = 2, k = 5e7;
      const double area =
          integrator.integrate([&](double u) { return u / (1 + alpha * u / v); }, 0.0, v);
      const double deformation = std::pow((n + 1) * m / k * area, 1 / (n + 1));
      EXPECT_NEAR(MaximumDeformation(m, v, k, n, alpha) / deformation, 1, 1e-12) << n << alpha;
    }
  }
}

// With v dv/dδ = −(k/m) δⁿ (1 + α v/v₀), integrated over v from v₀ to δ̇, before and after the turn.
TEST(ApproachVelocity, IsThatOfTheCollisionThroughADeformationAndAVelocity) {
  boost::math::quadrature::tanh_sinh<double> integrator;
  const double m = 0.3, v = 2, k = 5e7;
  for (const double n : {1.0, 1.5, 3.0}) {
    for (const double alpha : {0.0, 1e-6, 0.01, 0.5, 4.0, 50.0}) {
      const double back = DeliveredRestitution(alpha);
      for (const double part : {0.99, 0.5, 1e-8, 0.0, -1e-8, -0.5, -0.99}) {
        const double velocity = part > 0 ? part * v : part * back * v;
        const double area =
            integrator.integrate([&](double u) { return u / (1 + alpha * u / v); }, velocity, v);
        const double deformation = std::pow((n + 1) * m / k * area, 1 / (n + 1));
        EXPECT_NEAR(ApproachVelocity(m, deformation, velocity, k, n, alpha) / v, 1, 1e-9)
            << n << " " << alpha << " " << part;
      }
    }
  }
}

TEST(MaximumDeformation, DependsOnTheEnergyOverTheStiffnessAlone) {
  const double reference = MaximumDeformation(0.3, 2, 5e7, 1.5, 0.7);
  EXPECT_DOUBLE_EQ(MaximumDeformation(1.2, 1, 5e7, 1.5, 0.7), reference);
  EXPECT_DOUBLE_EQ(MaximumDeformation(0.6, 2, 1e8, 1.5, 0.7), reference);
  EXPECT_LT(MaximumDeformation(0.3, 2, 5e7, 1.5, 0.8), reference);
}

TEST(Power, SlopeIsTheDerivativeOfTheValue) {
  for (const double n : {1.0, 1.2, 1.5, 2.0, 3.0}) {
    for (const double deformation : {1e-6, 1e-4, 0.3}) {
      const double h = 1e-5 * deformation;
      const double difference =
          (Power(deformation + h, n).value - Power(deformation - h, n).value) / (2 * h);
      EXPECT_NEAR(Power(deformation, n).slope / difference, 1, 1e-8) << n << ' ' << deformation;
      EXPECT_NEAR(Power(deformation, n).value / std::pow(deformation, n), 1, 1e-14);
    }
  }
}

TEST(Power, OfHertzIsThatOfAnyOther) {
  for (const double deformation : {1e-9, 1e-5, 0.2, 3.0}) {
    const Power hertz(deformation, 1.5), near(deformation, std::nextafter(1.5, 2));
    EXPECT_NEAR(hertz.value / near.value, 1, 1e-14);
    EXPECT_NEAR(hertz.slope / near.slope, 1, 1e-14);
  }
}

TEST(ElasticEnergy, HasTheForceAsItsDerivative) {
  for (const double n : {1.0, 1.5, 2.2}) {
    const double deformation = 2e-4, h = 1e-9, k = 3e7;
    const double force =
        (ElasticEnergy(k, n, deformation + h) - ElasticEnergy(k, n, deformation - h)) / (2 * h);
    EXPECT_NEAR(force / (k * Power(deformation, n).value), 1, 1e-8) << n;
  }
}

}  // namespace
}  // namespace contact
