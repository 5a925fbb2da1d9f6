#pragma once

#include <Eigen/Core>

namespace contact {

/// The explicit Runge-Kutta pair of order 8(5,3) of Dormand and Prince, with the dense output of
/// order 7 of Hairer. Source: Hairer, Nørsett, Wanner, Solving Ordinary Differential
/// Equations I, 2nd ed., Springer 1993, II.5 and II.6 (DOP853).
///
/// Holds one step from (t, y0) to (t + h, y1) of y' = f(t, y). `f(t, y, dy)` gets arrays of
/// `size` numbers. Does not allocate between calls of Resize.
class DormandPrince {
 public:
  using Vector = Eigen::ArrayXd;

  void Resize(Eigen::Index size);
  Eigen::Index size() const { return y0.size(); }

  /// Computes y1 from y0 and the slope at y0, which must be in `slope0()`.
  template <class F>
  void Step(F&& f, double t, double h);

  /// Computes the slope at y1. Call after Step.
  template <class F>
  void FinishStep(F&& f, double t, double h) {
    f(t + h, y1.data(), k_.col(12).data());
  }

  /// Makes the end of the step the start of the next.
  void Advance() {
    y0.swap(y1);
    k_.col(0) = k_.col(12);
  }

  /// Prepares Interpolate. Call after FinishStep.
  template <class F>
  void PrepareInterpolation(F&& f, double t, double h);

  /// y at t + θ h, θ in [0, 1], to order 7.
  void Interpolate(double theta, Vector* y) const;

  /// The two error estimates of row i, to be combined by ErrorNorm.
  double Error5(Eigen::Index i) const;
  double Error3(Eigen::Index i) const;

  auto slope0() { return k_.col(0); }
  auto slope0() const { return k_.col(0); }
  auto slope1() const { return k_.col(12); }

  Vector y0, y1;

 private:
  void PrepareCoefficients(double h);

  Eigen::ArrayXXd k_;  // Slopes: 12 stages, the slope at y1, 3 for the dense output.
  Vector stage_;
  Eigen::ArrayXXd dense_;  // Coefficients of the interpolant.
};

}  // namespace contact

#include "simulation/dormand_prince_steps.h"  // IWYU pragma: export
