#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "simulation/motion/method_choice.h"
#include "simulation/motion/moving_system.h"
#include "simulation/motion/step_events.h"

namespace contact {

/// Takes steps that keep the tolerance, and makes them end on events: their length, their warp,
/// their error, their landing. README.md, "Integration".
class Stepper {
 public:
  /// The system must outlive the stepper.
  explicit Stepper(MovingSystem& system);

  /// The system is at a new State.
  void Begin();
  /// Computes a step, at most to `until`. False: none is short enough.
  bool Take(double until);
  /// Makes the step end on an event. False: the separation found is not there.
  bool Land(const StepEvents::Found& found);
  /// Takes where the step has ended into the scales by which errors are measured.
  void Widen();
  /// A contact has separated at the end of the step: the next is as long as those before.
  void Separated();

  /// No step goes further [s].
  double until() const { return until_; }
  /// The contact whose predicted separation ends the step, or kNone.
  int separating() const { return separating_; }

 private:
  /// Length and warp of the step to try next.
  StepTime Plan(double until);
  /// Computes a step of the classical method.
  void TakeFixed(double until);
  /// The warp of a step of h [s], with a separation expected `parting` [s] after its start.
  double Warp(double h, double parting = std::numeric_limits<double>::infinity()) const;
  /// Time until a contact in restitution is expected to separate [s]; infinite: not in sight.
  double TimeToSeparation(const ActiveContact& active) const;
  /// Local error of the step, in units of what the tolerance allows.
  double Error();
  /// The square of the relative error of a contact's work, in units of 1/h.
  double WorkError(const ActiveContact& active, double length) const;
  /// The largest Error() of a step.
  double MostError() const;
  /// Whether a collision begins and turns in the step.
  bool TurnsAtOnce() const;
  /// By what factor the step may be longer for an error of 1.
  double Growth(double error) const;
  /// The scale of a contact that sleeps: of its swing round-off is left, which is no motion. Zero
  /// of others.
  MovingSystem::Scale ScaleOfSleep(const ActiveContact& active, double deformation) const;
  /// The largest lengths [m] and speeds [m/s], of contacts and of all bodies, in a step of h [s].
  struct Extent {
    double length, speed, body_length, body_speed;
  };
  template <class Count>
  Extent Measure(Count n, double h) const;
  /// Error() of a step of h [s] with n bodies, from the error estimates of every u and v.
  template <class Count>
  double ErrorNorm(Count n, double h);
  /// The step is accepted: how long the next is to be, and by which method.
  void Adapt(double growth, bool repeated);
  /// Sets the length of the next step, and its method: that of an implicit step may end its use.
  void GoOn(double h);
  /// What is 0 at an event, a length [m] or a speed [m/s], and its slope.
  struct Residual {
    double value, slope;
  };
  /// That of an event, at the end of the step.
  Residual ResidualOf(const StepEvents::Found& found) const;
  /// That of an event of a support.
  Residual SlipResidual(const StepEvents::Found& found) const;
  /// Moves the end of the step by a short time [s].
  void Shift(double time, bool tangent);
  /// Computes the step of h [s] and its end; `parting`: it ends in a separation.
  void Compute(double h, bool parting);

  MovingSystem& system_;
  // Whether a step that misses its event by little is shifted there instead of repeated.
  const bool shifts_;
  // Error estimates of every u and v, of order 5 and 3; of an implicit step one estimate and 0.
  std::vector<double> error5_, error3_;
  MethodChoice choice_;
  // The largest μ δᵖ/m_e of a contact at the end of the step [1/s].
  double decay_ = 0;
  // Largest |u| [m] and |v| [m/s] while no contact was in touch.
  double flight_length_ = 0, flight_speed_ = 0;
  int separating_ = kNone;
  double until_ = 0;
  // The last step that no separation near has shortened [s].
  double cruise_ = 0;
  // Slopes before a Shift.
  Eigen::ArrayXd slope_;
};

}  // namespace contact
