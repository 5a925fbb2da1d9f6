#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace contact {

/// Time along a step, θ from 0 to 1: t = start + h (w θ + (1 − w) θ²), with the warp w in [0, 2].
/// w = 1 is plain. 0 crowds towards the start like t ~ θ², 2 towards the end like its mirror, so
/// that a solution in powers of √(t − start), or √(end − t), is smooth in θ.
struct StepTime {
  double start = 0;
  double h = 0;
  double warp = 1;

  double Offset(double theta) const { return h * (theta * (warp + (1 - warp) * theta)); }
  double At(double theta) const { return start + Offset(theta); }
  /// dt/dθ in units of h.
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
/// Holds one step from y0 to y1 of y' = f(t, y), taken in θ. `f(t, y, dy)` gets arrays of
/// `size` numbers; an f that takes a pace too gives dy by θ itself, `f(t, y, dy, dt/dθ/h)`. Does
/// not allocate between calls of Resize.
class RungeKutta {
 public:
  using Vector = Eigen::ArrayXd;
  enum class Method { kDormandPrince, kClassical };

  explicit RungeKutta(Method method = Method::kDormandPrince) : method_(method) {}

  /// Keeps what there is of y0 and slope0. f depends on the first `coupled` numbers of y only; the
  /// others are quadratures, which stages need not know.
  void Resize(Eigen::Index size, Eigen::Index coupled);
  void Resize(Eigen::Index size) { Resize(size, size); }
  Eigen::Index size() const { return y0.size(); }

  /// Computes y1 from y0 and slope0.
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

  /// The two error estimates of the first rows in units of h, to be combined. Dormand and Prince
  /// only.
  void Errors(Eigen::Index rows, double* error5, double* error3) const;

  Vector y0, y1;
  Vector slope0, slope1;  ///< dy/dt at the ends.

 private:
  template <class F>
  void Evaluate(F&& f, const StepTime& time, double theta, const double* y, int i);
  struct Term {
    double weight;
    int slope;
  };
  /// out = y0 + h Σ weight · slope, in the first rows.
  template <class Count, std::size_t N>
  void Combine(Vector& out, Count rows, double h, const Term (&terms)[N]);
  template <class F, class Count>
  void DormandPrinceStep(F&& f, const StepTime& time, Count coupled);
  template <class F>
  void ClassicalStep(F&& f, const StepTime& time);
  void PrepareCubic(double h);
  void PrepareCoefficients(double h);

  Method method_;
  Eigen::Index coupled_ = 0;
  Eigen::ArrayXXd k_;  // dy/dθ/h: 12 stages, the end, 3 for the dense output.
  Vector stage_;
  Eigen::ArrayXXd dense_;  // Coefficients of the interpolant.
};

}  // namespace contact

#include "simulation/motion/runge_kutta_steps.h"  // IWYU pragma: export
