#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "simulation/methods/rows.h"

namespace contact {

/// The linear system of an implicit step of bodies on a line: I plus what damping and stiffness add
/// between bodies that are not far apart.
///
/// Solved by Gaussian elimination within the band. Without exchange of rows: what damping and
/// stiffness add to I has its eigenvalues on the right, as the tables of the methods have.
class BandedSystem {
 public:
  /// `size` unknowns; no entry is more than `band` from the diagonal.
  void Resize(std::ptrdiff_t size, std::ptrdiff_t band) {
    size_ = size;
    band_ = band;
  }
  /// Begins anew with I.
  void Reset() {
    matrix_.assign(static_cast<std::size_t>(size_ * (2 * band_ + 1)), 0);
    for (std::ptrdiff_t i = 0; i < size_; ++i) At(i, i) = 1;
  }
  /// Adds to an entry.
  void Add(std::ptrdiff_t row, std::ptrdiff_t column, double value) { At(row, column) += value; }
  /// Decomposes the matrix into L and U, in its place. Call once before Solve.
  void Factor();
  /// Turns right sides into solutions: `count` of them, beside each other for each row.
  template <class Count>
  void Solve(Count count, double* sides) const;

 private:
  std::size_t Place(std::ptrdiff_t row, std::ptrdiff_t column) const {
    return static_cast<std::size_t>(row * 2 * band_ + column + band_);
  }
  double& At(std::ptrdiff_t row, std::ptrdiff_t column) { return matrix_[Place(row, column)]; }
  double At(std::ptrdiff_t row, std::ptrdiff_t column) const { return matrix_[Place(row, column)]; }
  /// One past the last row or column that the band of k reaches.
  std::ptrdiff_t End(std::ptrdiff_t k) const { return std::min(size_, k + band_ + 1); }
  /// Takes `factor` times the right sides of one row from those of another.
  template <class Count>
  static void Subtract(Count count, double factor, const double* side, double* from) {
    InRows(count, [&](auto rows, std::ptrdiff_t i) { rows(from + i) -= factor * rows(side + i); });
  }

  std::ptrdiff_t size_ = 0;
  // How far from the diagonal numbers may be.
  std::ptrdiff_t band_ = 0;
  // Row by row, from `band_` before the diagonal to as far behind it; after Factor L below the
  // diagonal, on it the inverses of those of U.
  std::vector<double> matrix_;
};

inline void BandedSystem::Factor() {
  for (std::ptrdiff_t k = 0; k < size_; ++k) {
    for (std::ptrdiff_t i = k + 1; i < End(k); ++i) {
      const double factor = At(i, k) /= At(k, k);
      for (std::ptrdiff_t j = k + 1; j < End(k); ++j) At(i, j) -= factor * At(k, j);
    }
    At(k, k) = 1 / At(k, k);
  }
}

template <class Count>
void BandedSystem::Solve(Count count, double* sides) const {
  for (std::ptrdiff_t k = 0; k < size_; ++k) {
    for (std::ptrdiff_t i = k + 1; i < End(k); ++i) {
      Subtract(count, At(i, k), sides + count * k, sides + count * i);
    }
  }
  for (std::ptrdiff_t k = size_ - 1; k >= 0; --k) {
    double* side = sides + count * k;
    for (std::ptrdiff_t j = k + 1; j < End(k); ++j) {
      Subtract(count, At(k, j), sides + count * j, side);
    }
    const double inverse = At(k, k);
    InRows(count, [&](auto rows, std::ptrdiff_t i) { rows(side + i) *= inverse; });
  }
}

}  // namespace contact
