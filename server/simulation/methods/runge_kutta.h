#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace contact {

/// Time along a step, θ from 0 to 1: t = start + h (w θ + (1 − w) θ²), with the warp w in [0, 2].
/// w = 1 is plain. 0 crowds towards the start like t ~ θ², 2 towards the end like its mirror, so
/// that a solution in powers of √(t − start), or √(end − t), is smooth in θ.
struct StepTime {
  /// Time at θ = 0 [s].
  double start = 0;
  /// Length of the step [s], > 0.
  double h = 0;
  /// w [-].
  double warp = 1;

  /// Time from the start to θ [s].
  double Offset(double theta) const { return h * (theta * (warp + (1 - warp) * theta)); }
  /// Time at θ [s].
  double At(double theta) const { return start + Offset(theta); }
  /// dt/dθ at θ, in units of h [-].
  double Rate(double theta) const { return warp + 2 * (1 - warp) * theta; }
  /// Length of the step that goes on from the end with the same clock, to θ = 1 + `growth`; with
  /// w > 1 at most to where the clock stands still.
  double Next(double growth) const {
    const double last = warp > 1 ? warp / (2 * (warp - 1)) : 1 + growth;
    return Offset(last < 1 + growth ? last : 1 + growth) - h;
  }
  /// θ at which the time is `t`.
  double Theta(double t) const;
};

/// Two explicit Runge-Kutta methods: the pair of order 8(5,3) of Dormand and Prince, with the
/// dense output of order 7 of Hairer, and the classical one of order 4 without error estimate,
/// with the cubic through both ends. Source: Hairer, Nørsett, Wanner, Solving Ordinary
/// Differential Equations I, 2nd ed., Springer 1993, II.1, II.5 and II.6 (DOP853).
///
/// Holds one step from y0 to y1 of y' = f(t, y), taken in θ. `f(t, y, dy, pace)` gets arrays of
/// `size` numbers and sets dy to pace · y'; without a pace, which is then 1, it sets dy to y'.
/// Every f that is handed to the methods of one step must be the same. Does not allocate between
/// calls of Resize.
class RungeKutta {
 public:
  using Vector = Eigen::ArrayXd;
  /// Which of the two methods.
  enum class Method { kDormandPrince, kClassical };

  explicit RungeKutta(Method method = Method::kDormandPrince) : method_(method) {}

  /// f depends on the first `coupled` numbers of y only; the others are quadratures, which stages
  /// need not know.
  void Resize(Eigen::Index size, Eigen::Index coupled);
  /// How many numbers y has.
  Eigen::Index size() const { return y0.size(); }

  /// Computes y1 from y0 and slope0. `time.start` is the time at y0.
  template <class F>
  void Step(F&& f, const StepTime& time);

  /// Computes slope1, at y1. Call after Step.
  template <class F>
  void FinishStep(F&& f, const StepTime& time) {
    f(time.At(1), y1.data(), slope1.data());
  }

  /// Makes the end of the step the start of the next.
  void Advance() {
    y0.swap(y1);
    slope0.swap(slope1);
  }

  /// Prepares Interpolate. Call after FinishStep.
  template <class F>
  void PrepareInterpolation(F&& f, const StepTime& time);

  /// y at θ, to order 7; to order 3 with the classical method.
  void Interpolate(double theta, Vector* y) const;

  /// The error estimates of order 5 and 3 of so many rows from `first` on, in units of h, to be
  /// combined. Call after Step. Dormand and Prince only.
  void Errors(Eigen::Index first, Eigen::Index rows, double* error5, double* error3) const;

  /// y at both ends of the step.
  Vector y0, y1;
  /// dy/dt at both ends of the step.
  Vector slope0, slope1;

 private:
  /// out = y0 + h Σ weight · slope, in the first `count` rows; kSlopes are columns of k_.
  template <int... kSlopes, class Count>
  void Combine(Vector& out, Count count, double h, const double (&weights)[sizeof...(kSlopes)]);
  /// Computes slope i at θ, where y = y0 + h Σ weight · slope: a row of the method's table.
  template <int... kSlopes, class F, class Count>
  void Stage(F&& f, const StepTime& time, Count count, int i, double theta,
             const double (&weights)[sizeof...(kSlopes)]);
  /// The method of order 8; `coupled` is a number or an integral constant.
  template <class F, class Count>
  void DormandPrinceStep(F&& f, const StepTime& time, Count coupled);
  /// The method of order 4.
  template <class F>
  void ClassicalStep(F&& f, const StepTime& time);
  /// The part of the interpolant that values and slopes at both ends determine.
  void PrepareCubic(double h);
  /// The terms of the interpolant above the cubic.
  void PrepareCoefficients(double h);

  const Method method_;
  Eigen::Index coupled_ = 0;
  // dy/dθ/h, a column each: 12 stages, the end, 3 for the dense output.
  Eigen::ArrayXXd k_;
  // y at a stage.
  Vector stage_;
  // Coefficients of the interpolant, a column each.
  Eigen::ArrayXXd dense_;
};

}  // namespace contact

#include "simulation/methods/runge_kutta_steps.h"  // IWYU pragma: export
