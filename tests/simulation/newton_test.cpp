#include "simulation/methods/newton.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <utility>

namespace contact {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Equations given as a function, with slopes by central differences unless they are given too.
class Given : public Residuals {
 public:
  using Function = std::function<VectorXd(const VectorXd&)>;
  explicit Given(Function function) : function_(std::move(function)) {}

  Value At(const VectorXd& x, bool slopes) override {
    ++evaluations;
    with_slopes += slopes;
    Value value{.residuals = function_(x), .slopes = {}};
    value.merit = value.residuals.squaredNorm();
    value.miss = value.residuals.lpNorm<Eigen::Infinity>();
    value.valid = value.residuals.allFinite();
    if (slopes) value.slopes = Slopes(x);
    return value;
  }
  void OnStep(double part) override { parts.push_back(part); }
  bool Aborted() const override { return evaluations >= most_evaluations; }

  int evaluations = 0, with_slopes = 0, most_evaluations = 1'000'000;
  std::vector<double> parts;

 private:
  MatrixXd Slopes(const VectorXd& x) const {
    MatrixXd slopes(x.size(), x.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const double h = 1e-6 * std::max(1.0, std::abs(x[i]));
      VectorXd low = x, high = x;
      low[i] -= h, high[i] += h;
      slopes.col(i) = (function_(high) - function_(low)) / (2 * h);
    }
    return slopes;
  }
  Function function_;
};

Newton::End Solve(Given& equations, VectorXd& x, const NewtonOptions& options = {}) {
  Newton newton(equations);
  return newton.Solve(options, equations.At(x, true), &x);
}

Given Rosenbrock() {
  return Given([](const VectorXd& x) { return VectorXd{{10 * (x[1] - x[0] * x[0]), 1 - x[0]}}; });
}

// Source of this and the next: Moré, Garbow, Hillstrom, Testing unconstrained optimization
// software, ACM Trans. Math. Software 7 (1981), problems 1, 13 and 27.
Given Powell() {
  return Given([](const VectorXd& x) {
    return VectorXd{{x[0] + 10 * x[1], std::sqrt(5) * (x[2] - x[3]), std::pow(x[1] - 2 * x[2], 2),
                     std::sqrt(10) * std::pow(x[0] - x[3], 2)}};
  });
}

Given Brown() {
  return Given([](const VectorXd& x) {
    VectorXd r = x.array() + x.sum() - static_cast<double>(x.size() + 1);
    r[x.size() - 1] = x.prod() - 1;
    return r;
  });
}

TEST(Newton, SolvesRosenbrocksValley) {
  Given equations = Rosenbrock();
  VectorXd x{{-1.2, 1}};
  EXPECT_EQ(Solve(equations, x), Newton::End::kSolved);
  EXPECT_NEAR(x[0], 1, 1e-9);
  EXPECT_NEAR(x[1], 1, 1e-9);
}

TEST(Newton, SolvesPowellsEquationsThoughTheirSlopesAreSingularAtTheRoot) {
  Given equations = Powell();
  VectorXd x{{3, -1, 0, 1}};
  EXPECT_EQ(Solve(equations, x), Newton::End::kSolved);
  EXPECT_LT(x.norm(), 1e-4);
}

TEST(Newton, SolvesBrownsAlmostLinearEquations) {
  Given equations = Brown();
  VectorXd x = VectorXd::Constant(10, 0.5);
  EXPECT_EQ(Solve(equations, x), Newton::End::kSolved);
  EXPECT_NEAR(x.head(9).prod() * x[9], 1, 1e-9);
}

TEST(Newton, SlopesAreAskedForOnlyOfStepsThatHelpWhereTheyAreDear) {
  Given equations = Rosenbrock();
  VectorXd x{{-1.2, 1}};
  EXPECT_EQ(Solve(equations, x, {.slopes_at_once = false}), Newton::End::kSolved);
  EXPECT_EQ(equations.with_slopes, static_cast<int>(equations.parts.size()));
  EXPECT_GT(equations.evaluations, equations.with_slopes);
}

TEST(Newton, StallsWhereThereIsNoRootAndStaysWhereItIsBest) {
  Given equations([](const VectorXd& x) { return VectorXd{{1 + x[0] * x[0]}}; });
  VectorXd x{{0.5}};
  EXPECT_EQ(Solve(equations, x), Newton::End::kStalled);
  EXPECT_LT(std::abs(x[0]), 0.5);
}

TEST(Newton, StallsAtAJumpInAFewSteps) {
  Given equations([](const VectorXd& x) { return VectorXd{{x[0] + (x[0] > 0 ? 1.0 : -1.0)}}; });
  VectorXd x{{3}};
  EXPECT_EQ(Solve(equations, x, {.most_trials = 3}), Newton::End::kStalled);
  EXPECT_LT(equations.evaluations, 20);
}

TEST(Newton, StallsWhereTangentsLeadTwiceBeyondWhatAStepCanMove) {
  Given equations([](const VectorXd& x) { return VectorXd{{2 + std::exp(x[0] / 10)}}; });
  VectorXd x{{0}};
  EXPECT_EQ(Solve(equations, x, {.limited = true}), Newton::End::kStalled);
  EXPECT_LE(equations.parts.size(), 1U);
}

TEST(Newton, TakesALastStepUnseenWhereItIsSureToDo) {
  Given equations = Brown();
  VectorXd x = VectorXd::Constant(10, 1 - 1e-5);
  EXPECT_EQ(Solve(equations, x, {.blind = 1e-4}), Newton::End::kUnseen);
  EXPECT_EQ(equations.evaluations, 1);
  EXPECT_NEAR(x.prod(), 1, 1e-6);
}

TEST(Newton, ObeysItsLimitsAndAnAbort) {
  Given limited = Rosenbrock(), aborted = Rosenbrock();
  VectorXd x{{-1.2, 1}}, y = x;
  EXPECT_EQ(Solve(limited, x, {.most_steps = 2}), Newton::End::kLimit);
  EXPECT_EQ(limited.parts.size(), 2U);
  aborted.most_evaluations = 3;
  EXPECT_EQ(Solve(aborted, y), Newton::End::kAborted);
}

}  // namespace
}  // namespace contact
