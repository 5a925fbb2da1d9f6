#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <stop_token>
#include <utility>
#include <vector>

#include "simulation/model/ledger.h"
#include "simulation/motion/contact_events.h"
#include "simulation/motion/equations.h"
#include "simulation/motion/runge_kutta.h"
#include "simulation/motion/tangents.h"

namespace contact {

/// Where a contact stands, and its running cycle.
struct ContactState {
  Phase phase = Phase::kOpen;
  /// δ = u_left − u_right − gap, with the displacements from State::positions [m].
  double gap = 0;
  /// Cycles started so far.
  int cycles = 0;
  /// μ of the last cycle; NaN before the first.
  double last_mu = kNaN;
  /// Largest W_c of its cycles so far [J].
  double largest_work = 0;
  /// Whether the last cycle was too weak to iterate.
  bool settled = false;
  /// Expected duration of the running cycle [s]; 0: unknown.
  double duration = 0;
  /// W since the start of the running cycle [J], (W1).
  double work = 0;
  /// E since the start of the running cycle [J], (W3); only of a recording.
  double external_work = 0;
  /// Sensitivity column of its μ in the running pass, or kNone.
  int column = kNone;
  /// Where F was largest so far in the running cycle. Only with PhaseSplit::kPeakForce.
  struct Peak {
    /// Instant [s]; NaN before F was positive.
    double time = kNaN;
    /// δ [m] and δ̇ [m/s].
    double deformation = 0, velocity = 0;
    /// W and E [J].
    double work = 0, external_work = 0;
  } peak;
  /// The running cycle, or what is known of the next: its contact and kind.
  Cycle cycle;
  /// Place of the running encounter among those of the contact, from 1.
  int encounter = 0;
  /// The group of the running cycle, and what decides where it ends. CycleHost keeps it.
  struct Membership {
    bool open = false;     ///< The next cycle of the encounter belongs to it too.
    int place = 0;         ///< Among the groups of the encounter, from 1.
    double lasts = 0;      ///< It does not end earlier after its start [s].
    int groups = 0;        ///< Group::number of the last group that has one.
    int iterations = 0;    ///< Corrections of its μ.
    double imbalance = 0;  ///< Sum of |(W4)| over its cycles [J].
    Group group;
  } member;
};

/// The system at an instant between two steps. Copied to roll back.
struct State {
  /// The instant [s].
  double time = 0;
  /// Step to try next [s]; 0: find one.
  double step = 0;
  /// Of each body [m].
  std::vector<double> positions;
  /// Of each body [m/s].
  std::vector<double> velocities;
  /// In order of Scenario::contacts.
  std::vector<ContactState> contacts;
  /// Work of the loads since t = 0 [J].
  double load_work = 0;
  /// Energy dissipated in supports since t = 0 [J].
  double support_loss = 0;
  /// Energy dissipated in cycles that have ended [J].
  double contact_loss = 0;
  /// Impulse of the external forces since t = 0 [N·s].
  double impulse = 0;
};

/// The state at t = 0: touching contacts that approach are starting.
State InitialState(const Scenario& scenario);

/// Whether loads, supports or walls may keep contacts closed.
bool IsPacking(const Scenario& scenario);

/// Whether a cycle runs or wants to start; a resting contact has none.
bool InCycle(const State& state);

/// Chooses the μ of cycles and hears of their ends. Called within Motion::Advance.
class CycleHost {
 public:
  virtual ~CycleHost() = default;
  /// What a cycle begins with.
  struct Factor {
    /// μ [N·s/mᵖ⁺¹], ≥ 0.
    double mu = 0;
    /// Sensitivity column of this μ, at most one past those in use; or kNone.
    int column = kNone;
    /// Expected δ_m − δ_s [m], for the error control; 0: unknown.
    double length = 0;
    /// Expected largest |δ̇| [m/s], for the error control; 0: unknown.
    double speed = 0;
  };
  /// A cycle begins: `state.cycle` holds contact, number, kind and start. `external_force` is F_e
  /// there [N].
  virtual Factor OnStart(ContactState& state, double effective_mass, double external_force) = 0;
  /// A cycle has ended; the gradients hold ∂W_c/∂μ and ∂W_r/∂μ of each column.
  /// May change status and bookkeeping of `state`. `length` and `speed` are what Factor expects.
  virtual void OnEnd(ContactState& state, const Eigen::ArrayXd& compression_gradient,
                     const Eigen::ArrayXd& restitution_gradient, double length, double speed) = 0;
  /// The cycle that OnStart heard of last for this contact has ended without duration or work: it
  /// counts as none, and the next cycle of the contact has its number.
  virtual void OnCancel(ContactState& /*state*/) {}
  /// A step begins; false: the host has seen enough.
  virtual bool OnStep() { return true; }
};

/// Hears of accepted steps when recording.
class StepListener {
 public:
  virtual ~StepListener() = default;
  /// The step in the integrator is accepted.
  virtual void OnStep(const StepTime& time) = 0;
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

  /// Takes over a state. Recording: quadratures of the ledger, and no tangents. `tolerance`
  /// takes the place of the scenario's; 0: the scenario's.
  void Begin(const State& state, bool recording, double tolerance = 0);

  /// Moves on until something of Pause happens. Begun where a cycle runs or starts, it goes on
  /// until none does; begun elsewhere, until one wants to start. Resting contacts do not count.
  Pause Advance(double until, CycleHost& host, StepListener* listener, const std::stop_token& stop,
                std::int64_t step_limit);

  /// The system where the last Advance has paused, for Begin.
  State Save() const;

  /// Simulated time [s].
  double time() const { return time_; }
  /// Steps tried since construction, rejected ones included.
  std::int64_t steps() const { return steps_; }
  /// Evaluations of the equations of motion since construction.
  std::int64_t evaluations() const { return evaluations_; }
  /// Counts on from what an earlier run has counted.
  void Restore(std::int64_t steps, std::int64_t evaluations) {
    steps_ = steps;
    evaluations_ = evaluations;
  }
  /// The equations as they are now: base, active contacts and layout of y.
  const Equations& equations() const { return equations_; }
  /// The step that the listener hears of, else the instant time() at y0.
  RungeKutta& integrator() { return rk_; }
  const RungeKutta& integrator() const { return rk_; }
  /// Prepares integrator().Interpolate for the step that the listener hears of.
  void PrepareInterpolation();
  /// In order of Scenario::contacts. Gaps are those at Begin; Save has those of now.
  const std::vector<ContactState>& contacts() const { return contacts_; }
  /// δ [m] of a contact for the displacements in y.
  double Deformation(int contact, const double* y) const;

 private:
  /// The first event of a step, and whose it is; kNone: there is none.
  struct Found {
    int contact = kNone;
    ContactEvent event;
  };

  /// Whether a cycle runs.
  bool Busy() const;
  /// Begins the cycles of all contacts that are starting, or of those among them that rest.
  void StartCycles(CycleHost& host, bool resting_only);
  /// Begins NIRV cycles of what touches the bodies of a collision at rest.
  void StartPushed(int collision, CycleHost& host);
  /// Begins the cycle of a contact whose kind is set.
  void StartCycle(int contact, CycleHost& host);
  /// Sets the scales to which a resting contact is integrated.
  void SetRestingScale(int contact);
  /// A first step for a cycle [s]: a small part of its duration.
  double FirstStep(int contact) const;
  /// The duration of a cycle that starts [s], from its scales; 0: they are unknown.
  double ExpectedDuration(int contact) const;
  /// Computes a step that keeps the tolerance. False: none is short enough.
  bool TakeStep(double until);
  /// Length and warp of the step to try next.
  StepTime Plan(double until);
  /// Computes a step of the classical method.
  void TakeFixedStep(double until);
  /// The warp of a step of h [s], with a separation expected `parting` [s] after its start.
  double Warp(double h, double parting = std::numeric_limits<double>::infinity()) const;
  /// Time until a contact in restitution is expected to separate [s]; infinite: not in sight.
  double TimeToSeparation(const ActiveContact& active) const;
  /// Local error of a step of h [s] with n bodies, in units of what the tolerance allows.
  template <class Count>
  double ErrorNorm(Count n, double h) const;
  /// Deformation of a contact that is to be taken for 0 [m].
  double Noise(int contact) const;
  /// The first event of the step that is not dealt with yet.
  Found FindEvent() const;
  /// Deals with the turns in the step. Returns the first other event.
  Found PassTurns();
  /// δ and its derivatives by θ at both ends of the step.
  std::pair<DeformationPath::End, DeformationPath::End> PathEnds(int contact) const;
  /// Makes the step end on an event. False: the separation found is not there.
  bool Land(const Found& found);
  /// By how much the step must be longer to end on an event [s], to first order.
  double Correction(const Found& found) const;
  /// Moves the end of the step by a short time [s].
  void Shift(double time, bool tangent);
  /// Computes the step of h [s] and its end; `parting`: it ends in a separation.
  void ComputeStep(double h, bool parting);
  /// Takes the tangents along the step, and to the turns in it.
  void FollowStep();
  /// Makes the end of the step the state, and tells the listener before.
  void Accept(StepListener* listener);
  /// Changes the phase of the contact whose event the step has ended on.
  void Apply(const Found& found, CycleHost& host);
  /// Ends the rest of contacts whose work has become worth a cycle.
  void WakeResting(CycleHost& host);
  /// Ends the compression of a contact at `time`, where the state is y.
  void Turn(ContactState& state, double time, const Eigen::ArrayXd& y);
  /// Ends the cycle of a contact at this instant.
  void EndCycle(ContactState& state, Cycle::End end, CycleHost& host);
  /// Takes back a cycle that has no duration or did no work.
  void CancelCycle(ContactState& state, CycleHost& host);
  /// Changes the sensitivities where a force begins (sign 1) or ends (−1) with a jump, (S3).
  void ShiftAtJump(int contact, double sign);
  /// Takes the largest force and the time of tension over the step into the cycle.
  void ObserveForce(const ActiveContact& active);
  /// Keeps the state at θ as that of the largest force.
  void KeepPeak(int contact, double theta);
  /// E of a contact in y [J]; 0 when not recording.
  double ExternalWork(int contact, const Eigen::ArrayXd& y) const;
  /// Takes the contacts in touch into the equations, and their slopes at this instant.
  void RefreshActive();
  /// Takes the loads that act from this instant on into the equations.
  void SelectLoads();

  const Scenario& scenario_;
  // Step of the classical method [s]; 0: error control.
  const double fixed_step_;
  const bool split_at_force_;
  // Whether a step that misses its event by little is shifted there instead of repeated.
  const bool shifts_;
  Equations equations_;
  RungeKutta rk_;
  std::vector<ContactState> contacts_;
  // Largest |δ − δ_s| of each contact's running cycle [m].
  std::vector<double> deformation_scale_;
  // Largest |δ̇| of each contact's running cycle [m/s].
  std::vector<double> velocity_scale_;
  Tangents tangents_;
  // ∂W/∂μ of each contact at the turn of its running cycle.
  std::vector<Eigen::ArrayXd> turn_gradient_;
  // The contacts that turn in the step, and when [s].
  std::vector<std::pair<int, double>> turns_;
  // The deformations of the active contacts in the step.
  std::vector<DeformationPath> paths_;
  // Error estimates of every u and v; scratch of ErrorNorm.
  mutable std::vector<double> error5_, error3_;
  // Largest |u| [m] and |v| [m/s] while no contact was in touch.
  double flight_length_ = 0, flight_speed_ = 0;
  // The balances at Begin, with the losses of the cycles that have ended since; nothing else.
  State totals_;
  // Shortest time in which a load or support changes [s].
  double forcing_time_ = 0;
  // The next instant at which a load begins or ends [s].
  double breakpoint_ = 0;
  // Relative tolerance of a step.
  double tolerance_;
  double time_ = 0;
  // The step in the integrator.
  StepTime step_;
  // The contact whose predicted separation ends the step, or kNone.
  int separating_ = kNone;
  // θ up to which each contact's events in the step are dealt with.
  std::vector<double> event_;
  // When the latest collision began [s]; NaN before the first since Begin.
  double touch_time_ = kNaN;
  // y at a turn inside the step; in Shift the slopes before it.
  Eigen::ArrayXd inside_;
  // Step to try next [s]; 0: find one.
  double next_step_ = 0;
  // The last step that no separation near has shortened [s].
  double cruise_ = 0;
  // Whether a contact rests.
  bool resting_ = false;
  std::int64_t steps_ = 0;
  std::int64_t evaluations_ = 0;
  double contact_loss_ = 0;
};

}  // namespace contact
