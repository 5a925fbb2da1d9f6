#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "simulation/methods/runge_kutta.h"
#include "simulation/motion/equations.h"
#include "simulation/motion/extrapolated_euler.h"
#include "simulation/motion/state.h"
#include "simulation/motion/tangents.h"

namespace contact {

/// The system between State and the next State, as the parts of Motion share it: where it is, and
/// the step that it is about to make.
struct MovingSystem {
  /// The scenario must outlive the system.
  explicit MovingSystem(const Scenario& scenario);
  MovingSystem(const MovingSystem&) = delete;
  MovingSystem& operator=(const MovingSystem&) = delete;

  /// Takes over a state; the arguments are those of Motion::Begin.
  void Begin(const State& state, bool recording, double tolerance);

  /// Step of the classical method [s]; 0: error control.
  double fixed_step() const { return scenario.solver.fixed_step; }
  /// Whether compression ends where F is largest, and not where δ is.
  bool splits_at_force() const { return scenario.solver.phase_split == PhaseSplit::kPeakForce; }
  /// δ [m] of a contact for the displacements in y.
  double Deformation(int contact, const double* y) const;
  /// E of a contact in y [J]; 0 when not recording.
  double ExternalWork(int contact, const Eigen::ArrayXd& y) const;
  /// δ and its derivatives by θ at both ends of the step.
  std::pair<DeformationPath::End, DeformationPath::End> PathEnds(int contact) const {
    return PathEnds(equations.sides(contact), -contacts[static_cast<std::size_t>(contact)].gap);
  }
  /// The same of the stretch of a support.
  std::pair<DeformationPath::End, DeformationPath::End> StretchEnds(std::size_t support) const {
    const Support& s = scenario.supports[support];
    return PathEnds(equations.SidesOf(s.body, s.other), equations.StretchAtBase(support));
  }

  /// Takes the contacts in touch into the equations, and their slopes at this instant.
  void RefreshActive();
  /// Takes the loads and drives that act from this instant on into the equations.
  void SelectLoads();
  /// Computes y1 of the step by one of the two methods.
  void TakeStep(bool implicitly);
  /// Puts driven bodies in y1 where they are then, and computes the slopes. Call after TakeStep.
  void FinishStep();
  /// Prepares Interpolate for the step.
  void PrepareInterpolation();
  /// y at θ in the step, from the dense output of its method.
  void Interpolate(double theta, Eigen::ArrayXd* y) const;

  /// Those of the distance of two sides that is `at_base` at displacements of 0.
  std::pair<DeformationPath::End, DeformationPath::End> PathEnds(const Sides& sides,
                                                                 double at_base) const;

  const Scenario& scenario;
  Equations equations;
  /// The step, whichever method has taken it.
  RungeKutta rk;
  ExtrapolatedEuler euler;
  Tangents tangents;
  /// In order of Scenario::contacts. Gaps are those at the last State.
  std::vector<ContactState> contacts;
  /// What the running cycle of a contact is measured by: the largest |δ − δ_s| [m] and |δ̇| [m/s]
  /// of it, or those expected.
  struct Scale {
    double length = 0, speed = 0;
  };
  std::vector<Scale> scales;
  /// Simulated time at y0 [s].
  double time = 0;
  /// The step in the integrator.
  StepTime step;
  /// Whether `euler` has taken it.
  bool implicit = false;
  /// Step to try next [s]; 0: find one.
  double next_step = 0;
  /// Relative tolerance of a step: the finest, or what was given instead.
  double finest;
  double tolerance;
  /// Order of implicit steps.
  int implicit_order = 0;
  /// When the latest collision began [s]; NaN before the first since the last State.
  double touch_time = kNaN;
  /// The next instant at which a load or drive begins or ends [s].
  double breakpoint = 0;
  /// Shortest time in which a load, drive or support changes [s].
  double forcing_time = 0;
  /// Whether a contact rests.
  bool resting = false;
  /// Largest Σ|m v| [N·s] and energy [J] seen in a recording since the last State.
  double momentum_scale = 0, energy_scale = 0;
  /// Energy dissipated in cycles that have ended [J].
  double contact_loss = 0;
  /// Steps tried, rejected ones included, and evaluations of the equations since construction.
  std::int64_t steps = 0, evaluations = 0;
};

[[gnu::always_inline]] inline std::pair<DeformationPath::End, DeformationPath::End>
MovingSystem::PathEnds(const Sides& sides, double at_base) const {
  const int n = equations.bodies();
  const double bend = 2 * step.h * (1 - step.warp);  // d²t/dθ²
  const auto end = [&](const auto& y, const auto& slope, double theta) {
    const double rate = sides.Relative(y.data() + n);
    const double acceleration = sides.Relative(slope.data() + n);
    const double dt = step.h * step.Rate(theta);
    return DeformationPath::End{sides.Relative(y.data()) + at_base, dt * rate,
                                dt * dt * acceleration + bend * rate};
  };
  auto first = end(rk.y0, rk.slope0, 0), last = end(rk.y1, rk.slope1, 1);
  if (implicit) {
    // Strong damping makes of small errors of δ̇ large ones of δ̈: the cubic without them.
    const double rise = 6 * (last.value - first.value);
    first.curvature = rise - 4 * first.slope - 2 * last.slope;
    last.curvature = 2 * first.slope + 4 * last.slope - rise;
  }
  return {first, last};
}

}  // namespace contact
