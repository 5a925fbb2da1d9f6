#pragma once

#include <limits>
#include <vector>

#include "simulation/model/ledger.h"
#include "simulation/model/scenario.h"
#include "simulation/motion/contact_events.h"

namespace contact {

/// An instant that never comes [s].
inline constexpr double kNever = std::numeric_limits<double>::infinity();

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
  /// Whether the running cycle has ended a rest, or began pressed with the run, and has not moved
  /// since.
  bool woken = false;
  /// Whether the running cycle gives back what was stored before it.
  bool released = false;
  /// By what the last cycle of a recording misses (W4) [J]; 0 until it ends.
  double imbalance = 0;
  /// δ̇ where the running cycle began [m/s]; of what rested before the rest of its swing.
  double start_velocity = 0;
  /// Of a contact that rests: when its rest ends at the latest, and the last instant at which one
  /// that ends later would have had its cause [s].
  double rest_until = kNever, rest_mark = 0;
  /// Expected duration of the running cycle [s]; 0: unknown.
  double duration = 0;
  /// Largest |δ − δ_s| [m] and |δ̇| [m/s] of the running cycle.
  double largest_motion = 0, largest_speed = 0;
  /// W since the start of the running cycle [J], (W1).
  double work = 0;
  /// E since the start of the running cycle [J], (W3); only of a recording.
  double external_work = 0;
  /// U where the running cycle began [J], (W2).
  double stored = 0;
  /// δ_y of its ForceTable: the largest δ at which it has turned since it touched [m].
  double yield = 0;
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
    bool open = false;        ///< The next cycle of the encounter belongs to it too.
    bool after_rest = false;  ///< Before it the contact has rested.
    bool disproved = false;   ///< One of its rows fails its proof,
    bool nothing = false;     ///< whose work is nothing beside that of others.
    int place = 0;            ///< Among the groups of the encounter, from 1.
    double lasts = 0;         ///< It does not end earlier after its start [s].
    int groups = 0;           ///< Group::number of the last group that has one.
    int iterations = 0;       ///< Corrections of its μ.
    double imbalance = 0;     ///< Sum of |(W4)| over its cycles [J].
    Group group;
  } member;
};

/// Where a support stands whose spring can slip.
struct Slip {
  /// How far its slack position has gone along [m].
  double slack = 0;
  /// 1: it slips while it grows longer, −1: while it grows shorter; 0: it does not slip.
  int side = 0;
};

/// Whether its cycle runs; a resting contact has none.
inline bool IsRunning(const ContactState& c) {
  return c.phase == Phase::kCompression || c.phase == Phase::kRestitution;
}

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
  /// In order of Scenario::supports.
  std::vector<Slip> slips;
  /// Work of the loads since t = 0 [J].
  double load_work = 0;
  /// Energy dissipated in supports since t = 0 [J].
  double support_loss = 0;
  /// Energy dissipated in cycles that have ended [J].
  double contact_loss = 0;
  /// Impulse of the external forces since t = 0 [N·s].
  double impulse = 0;
};

/// Whether the contact is pressed at t = 0.
inline bool StartsPressed(const ContactState& contact) {
  return contact.phase == Phase::kStarting && contact.gap < 0;
}

/// The state at t = 0: touching contacts that approach are starting, and so are pressed ones, as
/// after a rest that has ended, or that goes on where Scenario::starts_at_rest.
State InitialState(const Scenario& scenario);

/// Whether loads, drives, supports or walls may keep contacts closed.
bool IsPacking(const Scenario& scenario);

/// Whether the contact is at rest, or about to be.
inline bool Rests(const ContactState& contact) {
  return contact.phase == Phase::kResting || (contact.phase == Phase::kStarting && contact.settled);
}

/// Whether a cycle runs or wants to start; a resting contact has none.
bool InCycle(const State& state);

}  // namespace contact
