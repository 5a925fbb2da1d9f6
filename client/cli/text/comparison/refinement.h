#pragma once

#include <limits>

namespace contact::cli {

/// Observed order p of convergence, of a quantity at the steps h r², h r and h with r = `ratio` >
/// 1:
///   p = ln |(f₁ − f₂)/(f₂ − f₃)| / ln r.                                                 (V1)
/// NaN if two neighbours are equal.
double ObservedOrder(double coarse, double middle, double fine, double ratio);

/// The quantity at the step 0, by Richardson's extrapolation with the order p > 0:
///   f = f₃ + (f₃ − f₂)/(rᵖ − 1).                                                         (V2)
double Richardson(double middle, double fine, double ratio, double order);

/// What one quantity at three steps tells of its value at the step 0.
struct Refinement {
  /// The observed order; NaN if a difference is at the floor, or the values go to and fro.
  double order = std::numeric_limits<double>::quiet_NaN();
  /// The value at the step 0: Richardson's with `order`, or the finest where that is at the floor
  /// already, or the values do not settle.
  double limit = 0;
  /// False if the values neither approach a limit from one side, each closer than the one before,
  /// nor agree to the floor: then nothing tells how far the finest is from it.
  bool settles = false;
};

/// Steps are those of ObservedOrder. Differences of at most `floor` ≥ 0 are no differences.
Refinement Refine(double coarse, double middle, double fine, double ratio, double floor);

}  // namespace contact::cli
