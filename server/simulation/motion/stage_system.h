#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "simulation/motion/rows.h"

namespace contact {

/// The linear system of the accelerations of bodies on a line at the two stages of an implicit
/// Runge–Kutta method, with one right side for each μ: I plus a 2×2 block for each two bodies that
/// act on each other.
///
/// Solved by Gaussian elimination within the band of those blocks. Without exchange of rows: what
/// damping and stiffness add to I has its eigenvalues on the right, as the method's own table has.
class StageSystem {
 public:
  /// Bodies act on each other up to `reach` places apart.
  void Resize(std::ptrdiff_t bodies, std::ptrdiff_t reach) {
    size_ = 2 * bodies;
    band_ = 2 * reach + 1;
  }
  /// Begins anew with I.
  void Reset() {
    matrix_.assign(static_cast<std::size_t>(size_ * (2 * band_ + 1)), 0);
    for (std::ptrdiff_t i = 0; i < size_; ++i) At(i, i) = 1;
  }
  /// Adds `factor` times a block, in which the stages of `body` feel those of `other`.
  void Add(std::ptrdiff_t body, std::ptrdiff_t other, double factor, const double (&block)[2][2]) {
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) At(2 * body + i, 2 * other + j) += factor * block[i][j];
    }
  }
  /// Turns right sides into solutions: `count` numbers for each body and stage, those of both
  /// stages of a body beside each other. Spends the matrix.
  template <class Count>
  void Solve(Count count, double* sides);

 private:
  double& At(std::ptrdiff_t row, std::ptrdiff_t column) {
    return matrix_[static_cast<std::size_t>(row * 2 * band_ + column + band_)];
  }
  /// Takes `factor` times one right side from another.
  template <class Count>
  static void Subtract(Count count, double factor, const double* side, double* from) {
    InRows(count, [&](auto rows, std::ptrdiff_t i) { rows(from + i) -= factor * rows(side + i); });
  }

  std::ptrdiff_t size_ = 0;
  // How far from the diagonal numbers may be.
  std::ptrdiff_t band_ = 0;
  // Row by row, from `band_` before the diagonal to as far behind it.
  std::vector<double> matrix_;
};

template <class Count>
void StageSystem::Solve(Count count, double* sides) {
  for (std::ptrdiff_t k = 0; k < size_; ++k) {
    const std::ptrdiff_t end = std::min(size_, k + band_ + 1);
    for (std::ptrdiff_t i = k + 1; i < end; ++i) {
      const double factor = At(i, k) / At(k, k);
      if (factor == 0) continue;
      for (std::ptrdiff_t j = k + 1; j < end; ++j) At(i, j) -= factor * At(k, j);
      Subtract(count, factor, sides + count * k, sides + count * i);
    }
  }
  for (std::ptrdiff_t k = size_ - 1; k >= 0; --k) {
    double* side = sides + count * k;
    for (std::ptrdiff_t j = k + 1; j < std::min(size_, k + band_ + 1); ++j) {
      Subtract(count, At(k, j), sides + count * j, side);
    }
    const double inverse = 1 / At(k, k);
    InRows(count, [&](auto rows, std::ptrdiff_t i) { rows(side + i) *= inverse; });
  }
}

}  // namespace contact
