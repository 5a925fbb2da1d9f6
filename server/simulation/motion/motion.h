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

namespace contact {

/// Where a contact stands, and its running cycle.
struct ContactState {
  Phase phase = Phase::kOpen;
  double gap = 0;            ///< δ = u_left − u_right − gap [m].
  int cycles = 0;            ///< Started so far.
  double last_mu = kNaN;     ///< μ of the last cycle; NaN before the first.
  double largest_work = 0;   ///< Largest W_c of its cycles so far [J].
  bool settled = false;      ///< The last cycle was too weak to iterate.
  double work = 0;           ///< W since the cycle's start [J].
  double external_work = 0;  ///< E since the cycle's start [J].
  int column = kNone;        ///< Sensitivity column of its μ in the running pass.
  /// Where F was largest so far in the running cycle, with PhaseSplit::kPeakForce.
  struct Peak {
    double time = kNaN;
    double deformation = 0, velocity = 0;  ///< δ [m], δ̇ [m/s].
    double work = 0, external_work = 0;    ///< W, E [J].
  } peak;
  Cycle cycle;        ///< The running cycle.
  int encounter = 0;  ///< Place of the running encounter among those of the contact, from 1.
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

/// The system at an instant, between two steps. Copied to roll back.
struct State {
  double time = 0;                 ///< [s].
  double step = 0;                 ///< Step to try next [s]; 0: find one.
  std::vector<double> positions;   ///< [m].
  std::vector<double> velocities;  ///< [m/s].
  std::vector<ContactState> contacts;
  double load_work = 0;     ///< Work of the loads since t = 0 [J].
  double support_loss = 0;  ///< Dissipated in supports since t = 0 [J].
  double contact_loss = 0;  ///< Dissipated in cycles that have ended [J].
  double impulse = 0;       ///< Of external forces since t = 0 [N·s].
};

/// The state at t = 0: touching contacts that approach are starting.
State InitialState(const Scenario& scenario);

/// Whether loads, supports or walls may keep contacts closed.
bool IsPacking(const Scenario& scenario);

/// Whether a cycle runs or wants to start; a resting contact has none.
bool InCycle(const State& state);

/// Chooses the μ of cycles and hears of their ends.
class CycleHost {
 public:
  virtual ~CycleHost() = default;
  struct Factor {
    double mu = 0;
    int column = kNone;  ///< Sensitivity column, at most one past those in use; or kNone.
    double length = 0;   ///< Expected δ_m − δ_s [m] and
    double speed = 0;    ///< largest |δ̇| [m/s], for the error control; 0: unknown.
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
  enum class Pause {
    kTimeUp,       ///< `until` is reached.
    kCycleStarts,  ///< No cycle was running; one wants to begin.
    kQuiet,        ///< The last running cycle has ended.
    kEnough,       ///< The host has seen enough.
    kStepLimit,
    kStopped,
    kNumeric,
  };

  explicit Motion(const Scenario& scenario);

  /// Takes over a state. Recording: quadratures of the ledger; else: sensitivities. `tolerance`
  /// takes the place of the scenario's; 0: the scenario's.
  void Begin(const State& state, bool recording, double tolerance = 0);

  /// Moves on until something of Pause happens. Begun where a cycle runs or starts, it goes on
  /// until none does; begun elsewhere, until one wants to start. Resting contacts do not count.
  Pause Advance(double until, CycleHost& host, StepListener* listener, const std::stop_token& stop,
                std::int64_t step_limit);

  State Save() const;

  double time() const { return time_; }
  std::int64_t steps() const { return steps_; }  ///< Tried so far, in all.
  std::int64_t evaluations() const { return evaluations_; }
  /// Counts on from what an earlier run has counted.
  void Restore(std::int64_t steps, std::int64_t evaluations) {
    steps_ = steps;
    evaluations_ = evaluations;
  }
  const Equations& equations() const { return equations_; }
  RungeKutta& integrator() { return rk_; }
  const RungeKutta& integrator() const { return rk_; }
  /// Prepares integrator().Interpolate for the step that the listener hears of.
  void PrepareInterpolation();
  const std::vector<ContactState>& contacts() const { return contacts_; }
  double Deformation(int contact, const double* y) const;

 private:
  struct Found {
    int contact = kNone;
    ContactEvent event;
  };

  bool Busy() const;
  void StartCycles(CycleHost& host, bool resting_only);
  void StartPushed(int collision, CycleHost& host);
  void StartCycle(int contact, CycleHost& host);
  void AddColumn();
  void SetRestingScale(int contact);
  double FirstStep(int contact) const;
  bool TakeStep(double until);
  StepTime Plan(double until);
  void TakeFixedStep(double until);
  double Warp(double h, double parting = std::numeric_limits<double>::infinity()) const;
  double TimeToSeparation(const ActiveContact& active) const;
  template <class Count>
  double ErrorNorm(Count n, double h) const;
  double Noise(int contact) const;
  Found FindEvent() const;
  Found PassTurns();
  std::pair<DeformationPath::End, DeformationPath::End> PathEnds(int contact) const;
  bool Land(const Found& found);
  double Correction(const Found& found) const;
  void Shift(double time, bool tangent);
  void Repeat(double h, bool parting);
  void Accept(StepListener* listener);
  void Apply(const Found& found, CycleHost& host);
  void WakeResting(CycleHost& host);
  void Turn(ContactState& state, double time, const Eigen::ArrayXd& y);
  double SplitAtPeakForce(ContactState& state) const;
  void EndCycle(ContactState& state, Cycle::End end, CycleHost& host);
  void CancelCycle(ContactState& state, CycleHost& host);
  void ShiftAtJump(int contact, double sign);
  void ObserveForce(const ActiveContact& active);
  void KeepPeak(int contact, double theta);
  Eigen::ArrayXd WorkGradient(int contact, const Eigen::ArrayXd& y) const;
  void RefreshActive();
  void SelectLoads();

  const Scenario& scenario_;
  const double fixed_step_;  // Of the classical method [s]; 0: error control.
  const bool split_at_force_;
  const bool shifts_;  // To an event nearby, where it matters to no one by how little it is missed.
  Equations equations_;
  RungeKutta rk_;
  std::vector<ContactState> contacts_;
  std::vector<double> deformation_scale_;        // Largest |δ − δ_s| of the running cycle.
  std::vector<double> velocity_scale_;           // Largest |δ̇|.
  std::vector<Eigen::ArrayXd> start_gradient_;   // WorkGradient at t_s,
  std::vector<Eigen::ArrayXd> turn_gradient_;    // at t_m.
  mutable std::vector<double> error5_, error3_;  // Of every u and v; scratch of ErrorNorm.
  double flight_length_ = 0;                     // Largest |u| and
  double flight_speed_ = 0;                      // |v| while no cycle ran.
  State totals_;                                 // The balances at Begin.
  double forcing_time_ = 0;
  double breakpoint_ = 0;  // The next instant at which a load begins or ends.
  double tolerance_;       // Relative, of a step.
  double time_ = 0;
  StepTime step_;              // The step in the integrator.
  int separating_ = kNone;     // The contact whose predicted separation ends it.
  std::vector<double> event_;  // θ up to which each contact's events in it are dealt with.
  double touch_time_ = kNaN;   // When the latest collision began.
  Eigen::ArrayXd inside_;      // y at a turn inside the step; in Shift the slopes before it.
  double next_step_ = 0;
  double cruise_ = 0;     // The last step that no separation near has shortened.
  bool resting_ = false;  // Whether a contact rests.
  std::int64_t steps_ = 0;
  std::int64_t evaluations_ = 0;
  double contact_loss_ = 0;
};

}  // namespace contact
