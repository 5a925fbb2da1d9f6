#pragma once

#include <cstdint>
#include <stop_token>
#include <utility>
#include <vector>

#include "simulation/motion/cycle_host.h"
#include "simulation/motion/cycles.h"
#include "simulation/motion/force_watch.h"
#include "simulation/motion/moving_system.h"
#include "simulation/motion/slips.h"
#include "simulation/motion/state.h"
#include "simulation/motion/step_events.h"
#include "simulation/motion/stepper.h"

namespace contact {

/// Hears of accepted steps when recording.
class StepListener {
 public:
  virtual ~StepListener() = default;
  /// The step in the integrator is accepted.
  virtual void OnStep(const StepTime& time) = 0;
};

/// What has been done and lost since t = 0, (B1) [J].
struct Exchanged {
  double dissipated = 0;  ///< In contacts and supports.
  double load_work = 0;   ///< By loads and drives.
};

/// Moves the system forward in steps that land on contact events, and takes the contacts
/// through their phases. README.md, "Integration".
class Motion {
 public:
  /// Why Advance returned.
  enum class Pause {
    kTimeUp,       ///< `until` is reached.
    kCycleStarts,  ///< No cycle was running; one wants to begin.
    kQuiet,        ///< The last running cycle has ended.
    kEnough,       ///< The host has seen enough.
    kStepLimit,    ///< steps() has reached the limit.
    kStopped,      ///< A stop was requested.
    kNumeric,      ///< A value is not finite, or no step is short enough.
  };

  /// The scenario must outlive the motion.
  explicit Motion(const Scenario& scenario);

  /// The relative tolerance of what is begun without another; at first the scenario's.
  double finest() const { return system_.finest; }
  void set_finest(double tolerance) { system_.finest = tolerance; }
  /// Takes over a state. Recording: quadratures of the ledger, and no tangents. `tolerance`
  /// takes the place of the finest; 0: the finest.
  void Begin(const State& state, bool recording, double tolerance = 0);

  /// Moves on until something of Pause happens. Begun where a cycle runs or starts, it goes on
  /// until none does; begun elsewhere, until one wants to start. Resting contacts do not count.
  Pause Advance(double until, CycleHost& host, StepListener* listener, const std::stop_token& stop,
                std::int64_t step_limit);

  /// The system where the last Advance has paused, for Begin.
  State Save() const;

  /// Simulated time [s].
  double time() const { return system_.time; }
  /// Largest Σ|m v| of the recording since Begin [N·s].
  double momentum_scale() const { return system_.momentum_scale; }
  /// Largest energy of the recording since Begin [J].
  double energy_scale() const { return system_.energy_scale; }
  /// Length of the last step [s].
  double step() const { return system_.step.h; }
  /// Steps tried since construction, rejected ones included.
  std::int64_t steps() const { return system_.steps; }
  /// Evaluations of the equations of motion since construction.
  std::int64_t evaluations() const { return system_.evaluations; }
  /// Counts on from what an earlier run has counted.
  void Restore(std::int64_t steps, std::int64_t evaluations) {
    system_.steps = steps;
    system_.evaluations = evaluations;
  }
  /// The equations as they are now: base, active contacts and layout of y.
  const Equations& equations() const { return system_.equations; }
  /// The step that the listener hears of, else the instant time() at y0.
  const RungeKutta& integrator() const { return system_.rk; }
  /// Prepares Interpolate for the step that the listener hears of.
  void PrepareInterpolation() { system_.PrepareInterpolation(); }
  /// y at θ in the step that the listener hears of.
  void Interpolate(double theta, Eigen::ArrayXd* y) const { system_.Interpolate(theta, y); }
  /// What has been done and lost until a state y of the step that the listener hears of; in running
  /// cycles that is W less what is stored, (W2). Only of a recording.
  Exchanged ExchangedUntil(const Eigen::ArrayXd& y) const;
  /// In order of Scenario::contacts. Gaps are those at Begin; Save has those of now.
  const std::vector<ContactState>& contacts() const { return system_.contacts; }
  /// δ [m] of a contact for the displacements in y.
  double Deformation(int contact, const double* y) const { return system_.Deformation(contact, y); }

 private:
  /// Deals with the turns in the step. Returns the first other event.
  StepEvents::Found PassTurns();
  /// Ends the compression of a contact at about θ in the step.
  void PassTurn(int contact, double theta);
  /// The turn near the quintic's at θ, in an explicit step; uses inside_.
  double CorrectTurn(const Sides& sides, double theta);
  /// The turn in an implicit step, of which δ̈ is not good enough to correct θ; uses inside_.
  double SearchTurn(const Sides& sides, double theta);
  /// Takes the tangents along the step, and to the turns in it.
  void FollowStep();
  /// Makes the end of the step the state, and tells the listener before. Returns whether a load
  /// begins or ends there.
  bool Accept(StepListener* listener);

  MovingSystem system_;
  Stepper stepper_;
  StepEvents events_;
  Cycles cycles_;
  Slips slips_;
  ForceWatch forces_;
  // The balances at Begin; nothing else.
  State totals_;
  // The contacts that turn in the step, and when [s].
  std::vector<std::pair<int, double>> turns_;
  // The deformations of the active contacts, and the stretches of bent springs, in the step.
  std::vector<DeformationPath> paths_;
  // y at a turn inside the step.
  Eigen::ArrayXd inside_;
};

}  // namespace contact
