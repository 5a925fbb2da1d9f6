#include "simulation/motion/stage_system.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

namespace contact {
namespace {

constexpr std::ptrdiff_t kBodies = 7;

// Each two bodies up to `reach` apart act on each other like a damper of some strength.
void AddDampers(std::ptrdiff_t reach, StageSystem& system, Eigen::MatrixXd& dense) {
  dense = Eigen::MatrixXd::Identity(2 * kBodies, 2 * kBodies);
  system.Resize(kBodies, reach);
  system.Reset();
  const auto add = [&](std::ptrdiff_t i, std::ptrdiff_t j, double factor) {
    const double block[2][2] = {{0.25, -0.04}, {0.54, 0.25}};
    system.Add(i, j, factor, block);
    for (int a = 0; a < 2; ++a) {
      for (int b = 0; b < 2; ++b) dense(2 * i + a, 2 * j + b) += factor * block[a][b];
    }
  };
  for (std::ptrdiff_t i = 0; i < kBodies; ++i) {
    for (std::ptrdiff_t j = i + 1; j < kBodies && j <= i + reach; ++j) {
      const double strength = std::pow(10.0, static_cast<double>((3 * i + j) % 6));
      add(i, i, strength), add(i, j, -strength);
      add(j, j, 3 * strength), add(j, i, -3 * strength);
    }
  }
}

TEST(StageSystem, HasTheSolutionsOfTheDenseSystem) {
  for (const std::ptrdiff_t reach : {0, 1, 2, 6}) {
    for (const Eigen::Index count : {1, 3, 9}) {
      StageSystem system;
      Eigen::MatrixXd dense;
      AddDampers(reach, system, dense);
      Eigen::MatrixXd sides(count, 2 * kBodies);  // A row for each right side.
      for (Eigen::Index i = 0; i < sides.size(); ++i) {
        sides(i) = std::sin(static_cast<double>(i));
      }
      const Eigen::MatrixXd expected = dense.partialPivLu().solve(sides.transpose()).transpose();
      system.Solve(count, sides.data());
      EXPECT_LT((sides - expected).cwiseAbs().maxCoeff(), 1e-9 * expected.cwiseAbs().maxCoeff())
          << reach << ", " << count;
    }
  }
}

}  // namespace
}  // namespace contact
