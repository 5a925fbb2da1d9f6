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
    matrix_.assign(static_cast<std::size_t>((size_ + 1) * (2 * band_ + 1)), 0);
    for (std::ptrdiff_t i = 0; i < size_; ++i) At(i, i) = 1;
  }
  /// Adds to an entry.
  void Add(std::ptrdiff_t row, std::ptrdiff_t column, double value) { At(row, column) += value; }
  /// Adds `factor` times a block, of which this entry is the first.
  void Add(std::ptrdiff_t row, std::ptrdiff_t column, double factor, const double (&block)[2][2]) {
    double* to = &At(row, column);
    for (const auto& numbers : block) {
      to[0] += factor * numbers[0], to[1] += factor * numbers[1];
      to += Down();
    }
  }
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
  /// How far below it and behind it the band of k reaches.
  std::ptrdiff_t Reach(std::ptrdiff_t k) const { return std::min(band_, size_ - 1 - k); }
  /// From the place of a number to that of the one below it.
  std::ptrdiff_t Down() const { return 2 * band_; }
  /// Takes `factor` times `count` numbers from others.
  template <class Count>
  static void Subtract(Count count, double factor, const double* numbers, double* from) {
    InRows(count,
           [&](auto rows, std::ptrdiff_t i) { rows(from + i) -= factor * rows(numbers + i); });
  }

  std::ptrdiff_t size_ = 0;
  // How far from the diagonal numbers may be.
  std::ptrdiff_t band_ = 0;
  // Row by row, from `band_` before the diagonal to as far behind it, and a row past the last,
  // where a walk along the diagonal ends; after Factor L below the diagonal, on it the inverses of
  // those of U.
  std::vector<double> matrix_;
};

inline void BandedSystem::Factor() {
  double* diagonal = matrix_.data() + band_;
  for (std::ptrdiff_t k = 0; k < size_; ++k, diagonal += Down() + 1) {
    WithCount<1, 2, 3>(Reach(k), [&](auto reach) {
      for (std::ptrdiff_t i = 1; i <= reach; ++i) {
        double* row = diagonal + i * Down();
        const double factor = *row /= *diagonal;
        Subtract(reach, factor, diagonal + 1, row + 1);
      }
    });
    *diagonal = 1 / *diagonal;
  }
}

template <class Count>
void BandedSystem::Solve(Count count, double* sides) const {
  const double* diagonal = matrix_.data() + band_;
  double* side = sides;
  for (std::ptrdiff_t k = 0; k < size_; ++k, diagonal += Down() + 1, side += count) {
    WithCount<1, 2, 3>(Reach(k), [&](auto reach) {
      for (std::ptrdiff_t i = 1; i <= reach; ++i) {
        Subtract(count, diagonal[i * Down()], side, side + count * i);
      }
    });
  }
  for (std::ptrdiff_t k = size_; k-- > 0;) {
    diagonal -= Down() + 1, side -= count;
    WithCount<1, 2, 3>(Reach(k), [&](auto reach) {
      for (std::ptrdiff_t j = 1; j <= reach; ++j) {
        Subtract(count, diagonal[j], side + count * j, side);
      }
    });
    InRows(count, [&](auto rows, std::ptrdiff_t i) { rows(side + i) *= *diagonal; });
  }
}

}  // namespace contact
