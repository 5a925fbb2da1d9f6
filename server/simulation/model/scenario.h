#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "simulation/laws/damping_law.h"
#include "simulation/laws/force_table.h"

namespace contact {

// What to simulate: plain values in SI units, already checked by wire/.

/// "None", for indices. As a body: the ground, or a wall.
inline constexpr int kNone = -1;

/// A sphere on the x axis.
struct Body {
  std::string name;     ///< Unique among bodies.
  double mass = 1;      ///< m [kg], > 0.
  double radius = 0;    ///< R [m], ≥ 0.
  double position = 0;  ///< x at t = 0 [m].
  double velocity = 0;  ///< ẋ at t = 0 [m/s].
  /// No force moves it: it stands still, or moves as Scenario::drives say. Its mass counts nothing.
  bool fixed = false;
};

/// A place where two bodies, or a body and a wall, may touch. Deformation, positive in overlap:
///   pair         δ = r − (x_j − x_i)   i = left, j = right
///   wall right   δ = r − (b − x_i)     right = kNone
///   wall left    δ = r − (x_j − b)     left = kNone
/// with r the distance at which they touch: R_i + R_j, or R beside a wall; −c where the contact is
/// one of two with a play c between them.
struct Contact {
  std::string name;          ///< Unique among contacts.
  int left = kNone;          ///< Body pushed to the left, or kNone for a wall there.
  int right = kNone;         ///< Body pushed to the right, or kNone for a wall there.
  double wall_position = 0;  ///< b [m]; only with a wall.
  double play = 0;           ///< c [m]; 0: none.
  /// k [N/mⁿ], > 0. With a table the straight line from 0 to its last point, by which steps and
  /// guesses are scaled.
  double stiffness = 0;
  double exponent = 1.5;   ///< n [-], ≥ 1; 1 with a table.
  double restitution = 1;  ///< ε_in [-], in (0, 1]. Not used where IsGiven(damping).
  /// How μ is found.
  DampingLaw damping = DampingLaw::kEnergyRestitution;
  /// μ [N·s/mⁿ⁺¹] of DampingLaw::kGiven, c [N·s/m] of kDashpot; ≥ 0. Not used by others.
  double mu = 0;
  /// Approach velocity from which a named law makes μ [m/s], > 0; 0: that of the cycle.
  double reference_velocity = 0;
  /// The force of DampingLaw::kForceTable; empty with any other.
  ForceTable table = {};
};

/// A spring and damper: force on `body` −k d − k₂ d² − k₃ d³ − … − c ḋ, d = x − x_other − rest.
struct Support {
  int body = 0;              ///< Index in Scenario::bodies.
  int other = kNone;         ///< Index in Scenario::bodies; kNone: the ground, x_other = 0.
  double stiffness = 0;      ///< k [N/m], ≥ 0.
  double damping = 0;        ///< c [N·s/m], ≥ 0.
  double rest_position = 0;  ///< x − x_other without force [m].
  /// k₂, k₃, … [N/m², N/m³, …]; none: the spring is linear.
  std::vector<double> higher = {};
  /// Largest force of the spring [N], > 0, at which it slips; infinite unless it is linear, k > 0.
  double slip_force = std::numeric_limits<double>::infinity();

  /// Whether the force depends on the stretch alone, and on it linearly.
  bool IsLinear() const { return higher.empty() && std::isinf(slip_force); }
};

/// A smooth piece of a force on a body that depends on time only: in begin ≤ t < end
///   F(t) = constant + slope (t − begin) + amplitude sin(ω (t − begin) + φ),
/// else 0. Gravity is a constant m a; a table is a piece for each interval.
struct Load {
  int body = 0;                                          ///< Index in Scenario::bodies.
  double begin = 0;                                      ///< Begin of the piece [s], ≥ 0.
  double end = std::numeric_limits<double>::infinity();  ///< End of the piece [s], > begin.
  double constant = 0;                                   ///< Force at begin, without the sine [N].
  double slope = 0;                                      ///< Change of that force [N/s].
  double amplitude = 0;                                  ///< Amplitude of the sine [N].
  double angular_frequency = 0;                          ///< ω [rad/s], ≥ 0.
  double phase = 0;                                      ///< φ [rad].
};

/// A smooth piece of the motion of a fixed body: in begin ≤ t < end, with τ = t − begin,
///   x(t) = position + velocity τ + acceleration τ²/2 + jerk τ³/6 + amplitude sin(ω τ + φ).
/// The pieces of a body join without a jump of x and ẋ, and one begins at 0.
struct Drive {
  int body = 0;                                          ///< Index in Scenario::bodies.
  double begin = 0;                                      ///< Begin of the piece [s], ≥ 0.
  double end = std::numeric_limits<double>::infinity();  ///< End of the piece [s], > begin.
  double position = 0;                                   ///< x at begin, without the sine [m].
  double velocity = 0;                                   ///< ẋ of that [m/s].
  double acceleration = 0;                               ///< ẍ of that [m/s²].
  double jerk = 0;                                       ///< d³x/dt³ [m/s³].
  double amplitude = 0;                                  ///< Amplitude of the sine [m].
  double angular_frequency = 0;                          ///< ω [rad/s], ≥ 0.
  double phase = 0;                                      ///< φ [rad].
};

/// How μ is corrected between passes through an episode.
enum class UpdateRule {
  kNewtonCoupled,   ///< (N2) to (N4) of README.md.
  kPaperNewton,     ///< Paper (29), then (27).
  kPaperRatio,      ///< Paper (31), then (27).
  kPaperBisection,  ///< Doubling or halving, then paper (27).
};

/// How many cycles of a contact share one μ and one balance of works: a group.
enum class RestitutionScope {
  kAuto,       ///< One, and more where no μ of one alone has a solution.
  kCycle,      ///< Always one, as in the paper; some have no solution then.
  kEncounter,  ///< All from touch to separation, in pieces of SolverOptions::encounter_cycles.
};

/// Where a cycle's compression ends and its restitution begins.
enum class PhaseSplit {
  kPeakDeformation,  ///< δ̇ = 0.
  kPeakForce,        ///< The largest F, as in the paper's Table 2. Not with kNewtonCoupled.
};

/// How a scenario is solved.
struct SolverOptions {
  /// Step of the classical Runge-Kutta method [s]; 0: Dormand and Prince's with error control.
  double fixed_step = 0;
  /// How μ is corrected between passes.
  UpdateRule update = UpdateRule::kNewtonCoupled;
  /// Where the works W_c and W_r are cut.
  PhaseSplit phase_split = PhaseSplit::kPeakDeformation;
  /// Which cycles share one μ and one balance.
  RestitutionScope restitution_scope = RestitutionScope::kAuto;
  /// Cycles in a group of RestitutionScope::kEncounter, ≥ 1.
  int encounter_cycles = 8;
  /// Local error of a step that is accepted, relative to the contact's scale [-], > 0. Without
  /// effect with a fixed step.
  double relative_tolerance = 1e-11;
  /// ξ = |ε_out − ε_in|/ε_in that is accepted [-], > 0.
  double restitution_tolerance = 1e-8;
  /// Most corrections of μ in an episode, ≥ 1.
  int max_iterations = 50;
  /// A cycle that begins with a collision is settled, so not iterated, if its W_c is at most this
  /// part of the largest W_c of its contact [-].
  double settled_fraction = 1e-9;
  /// The same part for a cycle without initial relative velocity [-].
  double settled_nirv_fraction = 1e-4;
  /// Steps after which a run ends, rejected ones and those of all passes included.
  std::int64_t max_steps = 100'000'000;
  /// Whether the first cycle that is kNotConverged or kInfeasible ends the run.
  bool fail_if_not_converged = false;
  /// Whether a contact force below 0 counts as 0.
  bool clip_tension = false;
};

/// All that a run depends on. Indices in it are valid, and names unique.
struct Scenario {
  std::vector<Body> bodies;       ///< At least one.
  std::vector<Contact> contacts;  ///< May be none.
  std::vector<Support> supports;  ///< May be none.
  std::vector<Load> loads;        ///< May be none.
  std::vector<Drive> drives;      ///< May be none.
  SolverOptions solver;           ///< How it is solved.
  double end_time = 0;            ///< [s], > 0.
  /// Whether contacts that are pressed at t = 0 rest: the positions are those of an equilibrium.
  bool starts_at_rest = false;
  double sample_interval = 0;  ///< [s], > 0; 0: record no trajectory.
  /// Samples in each cycle beside those at multiples of the interval, ≥ 0.
  int samples_per_contact = 0;
  /// Most of these samples in the whole run, ≥ 0.
  std::int64_t most_contact_samples = std::numeric_limits<std::int64_t>::max();
  /// False if nobody asked for them: a cycle in which the interval is as short has none of its own,
  /// and a run does not warn where they end.
  bool wants_all_contact_samples = true;
  /// Samples are also taken where so many channels are least and largest between two others, if
  /// some channel turns twice there: F of each contact, then x and v of each body. 0, the number of
  /// contacts, or all.
  int turning_channels = 0;
};

/// "Not known", for numbers.
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace contact
