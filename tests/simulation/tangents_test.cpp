#include "simulation/motion/tangents.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "testing/cases.h"

namespace contact {
namespace {

// W of each contact in 0.2 ms, in which all stay closed, and ∂W/∂μ: a row for each μ.
struct Works {
  Eigen::ArrayXd works;
  Eigen::ArrayXXd tangents;
};

Works Follow(const Scenario& s, const std::vector<double>& mu, int steps, double warp = 1) {
  Equations equations(s);
  Tangents tangents(s, equations);
  const int contacts = equations.contacts(), n = equations.bodies();
  for (int c = 0; c < contacts; ++c) {
    equations.active.push_back(equations.Activate(c, 0, mu[static_cast<std::size_t>(c)], c));
    tangents.Add();
  }
  tangents.Prepare();
  RungeKutta rk;
  rk.Resize(equations.size(), equations.coupled());
  rk.y0.setZero();
  for (int i = 0; i < n; ++i) {
    rk.y0[i] = -3e-5 - 5e-5 * i;
    rk.y0[n + i] = -0.1 + 0.06 * i;
  }
  StepTime step{.h = 2e-4 / steps, .warp = warp};
  for (int i = 0; i < steps; ++i, step.start += step.h) {
    equations(step.start, rk.y0.data(), rk.slope0.data());
    rk.Step(equations, step);
    rk.FinishStep(equations, step);
    const auto end = [&](int contact, const auto& y, const auto& slope, double theta) {
      const double dt = step.h * step.Rate(theta);
      const double rate = equations.Relative(contact, y.data() + n);
      const double bend = 2 * step.h * (1 - warp);
      return DeformationPath::End{
          equations.Relative(contact, y.data()), dt * rate,
          dt * dt * equations.Relative(contact, slope.data() + n) + bend * rate};
    };
    std::vector<DeformationPath> paths;
    for (int c = 0; c < contacts; ++c) {
      paths.emplace_back(end(c, rk.y0, rk.slope0, 0), end(c, rk.y1, rk.slope1, 1));
    }
    tangents.Follow(step, paths, 0, 0.3);  // In two stretches, as to a turn and from it.
    tangents.Follow(step, paths, 0.3, 1);
    rk.Advance();
  }
  Works made{rk.y0.segment(equations.work(0), contacts), {}};
  made.tangents.resize(contacts, contacts);
  for (int c = 0; c < contacts; ++c) made.tangents.col(c) = tangents.Work(c);
  return made;
}

const std::vector<double> kMu = {1e8, 6e7, 3e7};

// `least`: each contact feels each μ at least so much, of what is felt of it most.
void ExpectDifferences(const Scenario& s, const std::vector<double>& mu, double warp,
                       double least) {
  const Works works = Follow(s, mu, 40, warp);
  for (std::size_t j = 0; j < mu.size(); ++j) {
    std::vector<double> more = mu, less = mu;
    const double change = 1e-4 * mu[j];
    more[j] += change;
    less[j] -= change;
    const Eigen::ArrayXd difference =
        (Follow(s, more, 40, warp).works - Follow(s, less, 40, warp).works) / (2 * change);
    EXPECT_GT(difference.abs().maxCoeff(), 0);
    EXPECT_GE(difference.abs().minCoeff(), least * difference.abs().maxCoeff());
    const Eigen::ArrayXd tangent = works.tangents.row(static_cast<Eigen::Index>(j));
    for (Eigen::Index c = 0; c < tangent.size(); ++c) {
      EXPECT_NEAR(tangent[c], difference[c], 5e-5 * difference.abs().maxCoeff())
          << "contact " << c << ", μ " << j << ", warp " << warp;
    }
  }
}

TEST(Tangents, AreTheDifferencesOfWorksByTheirMu) {
  for (const double warp : {0.0, 1.0, 1.7}) {
    ExpectDifferences(testing::Mixed(), kMu, warp, 1e-4);
  }
}

TEST(Tangents, FollowASpringBetweenTheEndsOfARow) {
  Scenario s = testing::Chain(std::vector<double>(12, 0.5), std::vector<double>(11, 1e8),
                              std::vector<double>(11, 0.8), 0.2, 1);
  s.supports = {
      {.body = 11, .other = 0, .stiffness = 1e6, .damping = 500, .rest_position = 11 * 0.1}};
  ExpectDifferences(s, std::vector<double>(11, 1e8), 1, 0);
}

TEST(Tangents, ConvergeWithOrderFour) {
  const Scenario s = testing::Mixed();
  const Eigen::ArrayXXd exact = Follow(s, kMu, 200).tangents;
  const auto error = [&](int steps) {
    return (Follow(s, kMu, steps).tangents - exact).abs().maxCoeff();
  };
  EXPECT_NEAR(std::log2(error(6) / error(12)), 4, 0.4);
  EXPECT_NEAR(std::log2(error(12) / error(24)), 4, 0.4);
}

// Steps of the motion may be longer than a contact takes to stop.
TEST(Tangents, FollowStiffContactsInParts) {
  const Scenario s = testing::Mixed();
  const std::vector<double> stiff = {3e9, 6e7, 3e7};
  const Eigen::ArrayXXd exact = Follow(s, stiff, 400).tangents;
  const Eigen::ArrayXXd coarse = Follow(s, stiff, 3).tangents;
  for (Eigen::Index j = 0; j < exact.rows(); ++j) {
    EXPECT_LT((coarse - exact).row(j).abs().maxCoeff(), 0.02 * exact.row(j).abs().maxCoeff()) << j;
  }
}

// A body creeps against a wall along δ = a + b t, F = k δ + c δ̇. Then m v̇ = −(k u + c v + b), of
// which the slow part is −b/c e^(−k t/c) in v: c/m is a million times k/c, so that all is damped in
// steps of which the slow motion is the only measure.
TEST(Tangents, CreepWithOrderThreeInStepsOfStrongDamping) {
  const double mass = 0.3, k = 5e7, c = 4e6, a = 2e-5, b = 1e-5, span = 2 * c / k;
  Scenario s = testing::Collision(mass, 1, k, 1, 1);
  s.contacts[0].damping = DampingLaw::kKelvinVoigt;
  const auto work = [&](int steps) {
    Equations equations(s);
    Tangents tangents(s, equations);
    equations.active.push_back(equations.Activate(0, 0, c, 0));
    tangents.Add();
    tangents.Prepare();
    const double h = span / steps;
    for (int i = 0; i < steps; ++i) {
      const double start = a + b * i * h;
      const std::vector<DeformationPath> path = {{{start, b * h, 0}, {start + b * h, b * h, 0}}};
      tangents.Follow({.start = i * h, .h = h}, path, 0, 1);
    }
    return tangents.Work(0)[0];
  };
  // W_μ = ∫ b (k u + c v + b) + F v dt, where b (…) = −b m v̇ is nothing beside F v.
  const double rate = k / c, end = std::exp(-rate * span);
  const double ramp = (1 - end * (1 + rate * span)) / rate;  // rate ∫ t e^(−rate t) dt
  const double exact = -b / c * ((k * a + c * b) * (1 - end) / rate + k * b * ramp / rate);
  const auto error = [&](int steps) { return std::abs(work(steps) / exact - 1); };
  EXPECT_LT(error(16), 1e-4);
  EXPECT_NEAR(std::log2(error(4) / error(8)), 3, 0.4);
}

}  // namespace
}  // namespace contact
