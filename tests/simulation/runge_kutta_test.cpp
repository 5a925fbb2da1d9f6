#include "simulation/methods/runge_kutta.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace contact {
namespace {

// A pendulum of large swing: smooth, nonlinear, periodic.
const auto kPendulum = [](double, const double* y, double* dy, double pace = 1) {
  dy[0] = pace * y[1];
  dy[1] = -pace * std::sin(y[0]);
};

RungeKutta OfSize(Eigen::Index size,
                  RungeKutta::Method method = RungeKutta::Method::kDormandPrince) {
  RungeKutta rk(method);
  rk.Resize(size, size);
  return rk;
}

Eigen::ArrayXd Integrate(int steps, double until) {
  RungeKutta rk = OfSize(2);
  rk.y0 << 2, 0;
  kPendulum(0, rk.y0.data(), rk.slope0.data());
  const double h = until / steps;
  for (int i = 0; i < steps; ++i) {
    rk.Step(kPendulum, {.start = i * h, .h = h});
    rk.FinishStep(kPendulum, {.start = i * h, .h = h});
    rk.Advance();
  }
  return rk.y0;
}

// y' = y cos t, whose solution is e^{sin t}.
double Error(int steps, RungeKutta::Method method = RungeKutta::Method::kDormandPrince) {
  const auto f = [](double t, const double* y, double* dy, double pace = 1) {
    dy[0] = pace * y[0] * std::cos(t);
  };
  RungeKutta rk = OfSize(1, method);
  rk.y0 << 1;
  f(0, rk.y0.data(), rk.slope0.data());
  const double h = 5.0 / steps;
  for (int i = 0; i < steps; ++i) {
    rk.Step(f, {.start = i * h, .h = h});
    rk.FinishStep(f, {.start = i * h, .h = h});
    rk.Advance();
  }
  return std::abs(rk.y0[0] - std::exp(std::sin(5.0)));
}

TEST(RungeKutta, HalvingTheStepDividesTheErrorByTwoToTheEight) {
  EXPECT_NEAR(std::log2(Error(8) / Error(16)), 8, 0.7);
  EXPECT_NEAR(std::log2(Error(16) / Error(32)), 8, 0.5);
}

TEST(RungeKutta, TheClassicalMethodHasOrderFour) {
  const auto classical = RungeKutta::Method::kClassical;
  EXPECT_NEAR(std::log2(Error(80, classical) / Error(160, classical)), 4, 0.1);
}

double DenseError(double h) {
  RungeKutta rk = OfSize(2);
  rk.y0 << 2, 0;
  kPendulum(0, rk.y0.data(), rk.slope0.data());
  rk.Step(kPendulum, {.start = 0, .h = h});
  rk.FinishStep(kPendulum, {.start = 0, .h = h});
  rk.PrepareInterpolation(kPendulum, {.start = 0, .h = h});
  double worst = 0;
  for (const double theta : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    Eigen::ArrayXd y;
    rk.Interpolate(theta, &y);
    worst = std::max(worst, (y - Integrate(100, theta * h)).abs().maxCoeff());
  }
  return worst;
}

TEST(RungeKutta, DenseOutputHasOrderSeven) {
  // The error inside one step is of order h^8.
  EXPECT_NEAR(std::log2(DenseError(0.8) / DenseError(0.4)), 8, 0.6);
}

TEST(RungeKutta, InterpolantMeetsBothEnds) {
  RungeKutta rk = OfSize(2);
  rk.y0 << 1, 0.5;
  kPendulum(0, rk.y0.data(), rk.slope0.data());
  rk.Step(kPendulum, {.start = 0, .h = 0.5});
  rk.FinishStep(kPendulum, {.start = 0, .h = 0.5});
  rk.PrepareInterpolation(kPendulum, {.start = 0, .h = 0.5});
  Eigen::ArrayXd y;
  rk.Interpolate(0, &y);
  EXPECT_EQ((y - rk.y0).abs().maxCoeff(), 0);
  rk.Interpolate(1, &y);
  EXPECT_LE((y - rk.y1).abs().maxCoeff(), 1e-16);
}

TEST(StepTime, ThetaInvertsAt) {
  for (const double warp : {0.0, 0.3, 1.0, 1.7, 2.0}) {
    const StepTime time{.start = 3, .h = 0.25, .warp = warp};
    EXPECT_EQ(time.At(0), 3);
    EXPECT_EQ(time.At(1), 3.25);
    for (const double theta : {0.0, 0.2, 0.5, 0.9, 1.0}) {
      EXPECT_NEAR(time.Theta(time.At(theta)), theta, 1e-7);
      EXPECT_NEAR(time.At(time.Theta(time.At(theta))), time.At(theta), 1e-15);
    }
  }
}

// y' = 3/2 √t from 0: smooth only in √t.
TEST(StepTime, AWarpMakesAFractionalPowerSmooth) {
  const auto f = [](double t, const double*, double* dy, double pace = 1) {
    dy[0] = pace * 1.5 * std::sqrt(t);
  };
  RungeKutta rk = OfSize(1);
  rk.y0 << 0;
  rk.slope0 << 0;
  rk.Step(f, {.start = 0, .h = 1, .warp = 1});
  EXPECT_GT(std::abs(rk.y1[0] - 1), 1e-5);
  rk.Step(f, {.start = 0, .h = 1, .warp = 0});
  EXPECT_LT(std::abs(rk.y1[0] - 1), 1e-14);
}

// The error estimate must not be smaller than the error by much, nor vanish.
TEST(RungeKutta, ErrorEstimatesFollowTheError) {
  RungeKutta rk = OfSize(2);
  for (const double h : {0.5, 1.0}) {
    rk.y0 << 2, 0;
    kPendulum(0, rk.y0.data(), rk.slope0.data());
    rk.Step(kPendulum, {.start = 0, .h = h});
    const double error = std::abs(rk.y1[1] - Integrate(100, h)[1]);
    double error5[2], error3[2];
    rk.Errors(0, 2, error5, error3);
    EXPECT_GT(h * std::abs(error5[1]), error);
    EXPECT_LT(h * std::abs(error5[1]), 1e5 * error);
    EXPECT_GT(std::abs(error3[1]), std::abs(error5[1]));
  }
}

// The step after, by the same clock: θ from 1 to 1 + growth.
TEST(StepTime, GoesOnWithTheSameClock) {
  const double h = 0.3;
  EXPECT_DOUBLE_EQ((StepTime{.start = 2, .h = h, .warp = 1}.Next(1.5)), 1.5 * h);
  EXPECT_DOUBLE_EQ((StepTime{.start = 2, .h = h, .warp = 0}.Next(1)), 3 * h);  // √t: 1² to 2².
  const StepTime ending{.start = 2, .h = h, .warp = 1.5};  // Its clock stands still at θ = 1.5.
  EXPECT_DOUBLE_EQ(ending.Next(9), ending.Next(0.5));
  EXPECT_EQ((StepTime{.start = 2, .h = h, .warp = 2}.Next(1)), 0);
}

// y'' = −y with the quadrature of y: stages that do not know the quadrature change nothing.
TEST(RungeKutta, StagesNeedNotKnowQuadratures) {
  const auto slope = [](double, const double* y, double* dy, double pace = 1) {
    dy[0] = pace * y[1];
    dy[1] = -pace * y[0];
    dy[2] = pace * y[0];
  };
  const StepTime time{.start = 0, .h = 0.4, .warp = 0.6};
  RungeKutta all = OfSize(3), some = OfSize(3);
  some.Resize(3, 2);
  for (RungeKutta* rk : {&all, &some}) {
    rk->y0 << 1, 0.5, 0;
    slope(0, rk->y0.data(), rk->slope0.data());
    rk->Step(slope, time);
  }
  EXPECT_TRUE((all.y1 == some.y1).all());
}

// A quadrature of tᵖ: each method is exact up to p = order − 1, and no further.
TEST(RungeKutta, PolynomialsUpToTheOrderAreExact) {
  for (const auto method : {RungeKutta::Method::kDormandPrince, RungeKutta::Method::kClassical}) {
    const int order = method == RungeKutta::Method::kDormandPrince ? 8 : 4;
    for (int p = 0; p <= order; ++p) {
      const auto f = [p](double t, const double*, double* dy, double pace = 1) {
        dy[0] = pace * (p + 1) * std::pow(t, p);
      };
      RungeKutta rk = OfSize(1, method);
      rk.y0 << 0;
      f(0, rk.y0.data(), rk.slope0.data());
      rk.Step(f, {.start = 0, .h = 1.5});
      const double error = std::abs(rk.y1[0] / std::pow(1.5, p + 1) - 1);
      EXPECT_EQ(error < 1e-14, p < order) << p << ' ' << error;
    }
  }
}

// What is linear in y and kept by f, as a momentum is, is kept by every step and inside it.
TEST(RungeKutta, LinearInvariantsAreKept) {
  const auto exchange = [](double t, const double* y, double* dy, double pace = 1) {
    const double flow = pace * std::sin(t + y[0] * y[1]);
    dy[0] = flow;
    dy[1] = -flow;
  };
  for (const double warp : {0.0, 1.0, 1.7}) {
    RungeKutta rk = OfSize(2);
    rk.y0 << 3, 4;
    exchange(0, rk.y0.data(), rk.slope0.data());
    const StepTime time{.start = 0, .h = 0.7, .warp = warp};
    rk.Step(exchange, time);
    rk.FinishStep(exchange, time);
    rk.PrepareInterpolation(exchange, time);
    EXPECT_NEAR(rk.y1.sum(), 7, 1e-14);
    for (const double theta : {0.2, 0.6, 0.95}) {
      Eigen::ArrayXd y;
      rk.Interpolate(theta, &y);
      EXPECT_NEAR(y.sum(), 7, 1e-14) << theta;
      EXPECT_GT(std::abs(y[0] - 3), 1e-3) << theta;  // Though both change.
    }
  }
}

}  // namespace
}  // namespace contact
