#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "simulation/methods/banded_system.h"
#include "simulation/model/scenario.h"
#include "simulation/motion/equations.h"
#include "simulation/motion/linked_bodies.h"

namespace contact {

/// The linearly implicit Euler method, extrapolated: for motions that damp so strongly that the
/// steps of an explicit method must be far shorter than what the motion itself demands.
///
/// A step of h is taken in 1, 2, 3, … parts of Euler's method, each a linear system with the
/// derivatives of the forces at the start of the step; what these approximations T₁, T₂, … tend to
/// is of order k after k of them. Source: Hairer, Wanner, Solving Ordinary Differential Equations
/// II, 2nd ed., Springer 1996, IV.9 (SEULEX). Bodies that links join to a driven one are integrated
/// in its frame, in which it stands still: what is damped follows it, and Euler's method would be
/// late by what no extrapolation takes back. Does not allocate once it has taken a step.
class ExtrapolatedEuler {
 public:
  using Vector = Eigen::ArrayXd;

  /// Both must outlive the method.
  ExtrapolatedEuler(const Scenario& scenario, const Equations& equations)
      : scenario_(scenario), equations_(equations), linked_(scenario, equations) {}

  /// Call before the first step, and when the active contacts or drives have changed.
  void Prepare();

  /// Computes y1, `h` [s] after y0, to order k ≥ 2. `slope0` are the slopes at y0, at `time` [s].
  void Step(const Vector& y0, const Vector& slope0, double time, double h, int k, Vector* y1);
  /// Prepares Interpolate for the step of the same arguments, to y1: takes it anew up to each of
  /// kNodes places inside it.
  void PrepareInterpolation(const Vector& y0, const Vector& slope0, double time, double h, int k,
                            const Vector& y1);
  /// y at θ of the step, from 0 at its start to 1, of order kNodes + 1.
  void Interpolate(double theta, Vector* y) const;
  static constexpr int kNodes = 6;
  /// Evaluations of the equations of motion that a step of order k takes.
  static int Evaluations(int k) { return k * (k + 1) / 2; }
  /// The last step's difference from one of order k − 1, over h: an estimate of the error of that.
  const Vector& error() const { return error_; }

 private:
  /// Derivatives of the force of a link by δ [N/m] and δ̇ [N·s/m].
  struct Law {
    double by_deformation = 0, by_rate = 0;
  };

  /// The laws of all links at y0.
  void Linearize(const Vector& y0);
  /// T of so many parts, as the motion from y0, into its column of the table.
  void Integrate(const Vector& y0, const Vector& slope0, double time, double h, int parts);
  /// Adds to the motion of carried bodies by how much Euler's method misses that of their drive.
  void Carry(double from, double to, Eigen::Ref<Vector> moved) const;
  /// The linear system of a part of so many seconds.
  void Assemble(double part);
  /// Puts the accelerations of the implicit method into slope_, in place of those at its start.
  void Accelerate(double part);
  /// Extrapolates with the approximation of so many parts.
  void Extrapolate(int parts);

  const Scenario& scenario_;
  const Equations& equations_;
  LinkedBodies linked_;
  // Which of Equations::driving carries each body, or kNone.
  std::vector<int> carriers_;
  // In the order of links.
  std::vector<Law> laws_;
  BandedSystem system_;
  // What was extrapolated last from T₁ … T_j: to order k in column j − k.
  Eigen::ArrayXXd table_;
  // y and its slopes where a part begins.
  Vector y_, slope_;
  // Accelerations of the linked bodies.
  Vector sides_;
  Vector error_;
  // y at both ends of the step and at the places inside it.
  std::array<Vector, kNodes + 2> nodes_;
};

}  // namespace contact
