#include "simulation/methods/banded_system.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

namespace contact {
namespace {

constexpr std::ptrdiff_t kSize = 14;

// Each two unknowns up to `band` apart act on each other like a damper of some strength.
void AddDampers(std::ptrdiff_t band, BandedSystem& system, Eigen::MatrixXd& dense) {
  dense = Eigen::MatrixXd::Identity(kSize, kSize);
  system.Resize(kSize, band);
  system.Reset();
  const auto add = [&](std::ptrdiff_t i, std::ptrdiff_t j, double value) {
    system.Add(i, j, value);
    dense(i, j) += value;
  };
  for (std::ptrdiff_t i = 0; i < kSize; ++i) {
    for (std::ptrdiff_t j = i + 1; j < kSize && j <= i + band; ++j) {
      const double strength = std::pow(10.0, static_cast<double>((3 * i + j) % 6));
      add(i, i, strength), add(i, j, -strength);
      add(j, j, 3 * strength), add(j, i, -3 * strength);
    }
  }
}

TEST(BandedSystem, HasTheSolutionsOfTheDenseSystem) {
  for (const std::ptrdiff_t band : {0, 1, 3, 13}) {
    for (const Eigen::Index count : {1, 3, 9}) {
      BandedSystem system;
      Eigen::MatrixXd dense;
      AddDampers(band, system, dense);
      system.Factor();
      for (const double shift : {0.0, 1.0}) {  // It solves for one set of sides after the other.
        Eigen::MatrixXd sides(count, kSize);   // A row for each right side.
        for (Eigen::Index i = 0; i < sides.size(); ++i) {
          sides(i) = std::sin(static_cast<double>(i) + shift);
        }
        const Eigen::MatrixXd expected = dense.partialPivLu().solve(sides.transpose()).transpose();
        system.Solve(count, sides.data());
        EXPECT_LT((sides - expected).cwiseAbs().maxCoeff(), 1e-9 * expected.cwiseAbs().maxCoeff())
            << band << ", " << count;
      }
    }
  }
}

}  // namespace
}  // namespace contact
