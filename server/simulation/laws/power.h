#pragma once

#include <cmath>

namespace contact {

/// δⁿ and its derivative n δⁿ⁻¹; both 0 for δ ≤ 0.
struct Power {
  /// δⁿ [mⁿ].
  double value = 0;
  /// n δⁿ⁻¹ [mⁿ⁻¹].
  double slope = 0;

  Power(double deformation, double exponent) {
    if (deformation <= 0) return;
    const double root =
        exponent == 1.5 ? std::sqrt(deformation) : std::pow(deformation, exponent - 1);
    value = deformation * root;
    slope = exponent * root;
  }
};

}  // namespace contact
