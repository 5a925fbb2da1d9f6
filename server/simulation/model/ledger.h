#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "simulation/model/scenario.h"

namespace contact {

/// One compression of one contact and the restitution that follows it: a row of the ledger. Letters
/// and equation numbers are those of README.md. A cycle lasts: start_time < end_time, and unless it
/// rested its compression does work.
struct Cycle {
  /// How the cycle begins.
  enum class Kind {
    kCollision,  ///< At δ = 0 with δ̇⁻ > 0.
    kNirv,       ///< Without initial relative velocity: touching, or still compressed.
  };
  /// How the cycle ends.
  enum class End {
    kSeparation,     ///< δ falls to 0.
    kNonSeparation,  ///< δ̇ rises to 0 with δ > 0; the next cycle begins there.
    kRunEnd,         ///< The run ends while the cycle lasts.
  };
  /// What became of the request for its restitution.
  enum class Status {
    kConverged,  ///< |ε_out − ε_in| ≤ ξ ε_in.
    kGivenLaw,   ///< μ follows from a law or is given; nothing is iterated.
    kInfeasible,  ///< No μ ≥ 0 of its group gives ε_in, and the group may not grow, README.md (N5).
    kSettled,       ///< Its work is too small to iterate, or it is a contact's rest.
    kNotConverged,  ///< The iteration ended without any of these.
    kJump,          ///< As μ changes, ε_out jumps over ε_in; Group tells both sides.
    kUnfinished,  ///< The end of the run cuts it, and no μ was found for its group: it has a guess.
    kReleased,    ///< A restitution without compression: it gives back what was stored before.
    kLimited,     ///< No μ of its group gives ε_in, for loads drive it; it has a guess.
    kCut,         ///< The end of the run cuts it; μ is that of a look beyond the end.
  };

  int contact = 0;  ///< Index in Scenario::contacts.
  int number = 1;   ///< Place among the cycles of its contact, from 1 without gaps.
  int group = 0;    ///< Group::number of its group, from 1; 0: it settled, in none.
  int episode = 1;  ///< Number of its episode, from 1; cycles of an episode are solved together.
  Kind kind = Kind::kCollision;           ///< How it begins.
  End end = End::kRunEnd;                 ///< How it ends.
  Status status = Status::kNotConverged;  ///< What became of ε_in.
  int iterations = 0;                     ///< Corrections of μ made for the episode, ≥ 0.

  double start_time = 0;              ///< t_s [s], ≥ 0.
  double turn_time = kNaN;            ///< t_m [s]; NaN if the run ended before.
  double end_time = 0;                ///< t_o [s], > t_s.
  double start_deformation = 0;       ///< δ_s [m], ≥ 0; 0 for a collision.
  double max_deformation = 0;         ///< δ_m [m], ≥ δ_s.
  double end_deformation = 0;         ///< δ_o [m], ≥ 0; 0 for a separation.
  double approach_velocity = 0;       ///< δ̇⁻ [m/s], ≥ 0; 0 for kNirv.
  double separation_velocity = 0;     ///< δ̇⁺ [m/s], ≤ 0; 0 without separation.
  double mu = 0;                      ///< μ [N·s/mᵖ⁺¹], ≥ 0.
  double work_compression = 0;        ///< W_c [J], (W1); > 0 unless it rested.
  double work_restitution = 0;        ///< W_r [J], (W1); ≤ 0 unless the contact pulls.
  double dissipated_compression = 0;  ///< Dissipated in compression [J], (W2).
  double dissipated_restitution = 0;  ///< Dissipated in restitution [J], (W2).
  double external_compression = 0;    ///< Work of F_e in compression [J], (W3).
  double external_restitution = 0;    ///< Work of F_e in restitution [J], (W3).
  double restitution_in = kNaN;       ///< ε_in [-], in (0, 1]; NaN for a given μ.
  double restitution_out = kNaN;      ///< ε_out = √(−W_r/W_c) [-], (W5); NaN if not real.
  double peak_force = 0;              ///< Largest F [N], ≥ 0.
  double tension_time = 0;            ///< Time for which F < 0 [s], ≥ 0.
  double identity_residual = 0;       ///< Miss of (W4), relative to W_c [-], ≥ 0.
};

/// Why a group took in its neighbour.
enum class Growth {
  kNotGrown,    ///< It did not: one cycle, or RestitutionScope::kEncounter.
  kTooLittle,   ///< Too little came back even without damping.
  kTooMuch,     ///< Too much came back whatever the damping.
  kJump,        ///< What came back jumped over what was asked for.
  kNoProgress,  ///< The search found nothing better.
};

/// Consecutive cycles of one contact in one encounter, that share one μ and one balance.
struct Group {
  /// A μ that was tried, and the ε_out to which it led; NaN: none was.
  struct Reached {
    double mu = kNaN;
    double restitution = kNaN;
  };
  int contact = 0;      ///< Index in Scenario::contacts.
  int number = 1;       ///< Place among the groups of its contact, from 1.
  int encounter = 1;    ///< Place of its encounter among those of its contact, from 1.
  int first_cycle = 1;  ///< Cycle::number of its first.
  int cycles = 0;       ///< How many.
  double start_time = 0, end_time = 0;  ///< [s].
  Cycle::End end = Cycle::End::kRunEnd;
  Cycle::Status status = Cycle::Status::kNotConverged;
  Growth growth = Growth::kNotGrown;  ///< Why it grew last.
  double mu = 0;                      ///< μ [N·s/mⁿ⁺¹].
  double work_compression = 0;        ///< Sum of W_c of its cycles, a cut one included [J].
  double work_restitution = 0;        ///< Sum of W_r [J], ≤ 0.
  double restitution_in = kNaN;
  double restitution_out = kNaN;           ///< √(−W_r/W_c).
  double residual = 0;                     ///< |(W4)| summed over its cycles, / W_c.
  bool beside_cut = false;                 ///< See Groups::NoteCut.
  Reached too_much = {}, too_little = {};  ///< Of those without a μ: the nearest on either side.
  std::vector<double> other_roots = {};    ///< Larger μ with ε_in that the search has seen.
};

/// One pass through an episode with one set of μ.
struct Iteration {
  /// How a μ was changed before the pass.
  enum class Update {
    kNothing,       ///< It was not.
    kNewton,        ///< A whole step of Newton, (N3).
    kDampedNewton,  ///< A shortened step of Newton, (N3).
    kBisection,     ///< The middle of the bracket, paper (27).
    kZero,          ///< No search says it any more; the contract keeps the number.
    kPaperNewton,   ///< Paper (29).
    kPaperRatio,    ///< Paper (31).
    kBracketing,    ///< Doubling or halving in search of a bracket.
  };
  /// One cycle of the episode, as this pass saw it.
  struct Unknown {
    int contact = 0;                   ///< Index in Scenario::contacts.
    int number = 1;                    ///< Place among the cycles of its contact, from 1.
    double mu = 0;                     ///< μ of the pass [N·s/mᵖ⁺¹], ≥ 0.
    double restitution_out = kNaN;     ///< ε_out of the pass [-]; NaN if not real or not seen.
    double restitution_in = kNaN;      ///< ε_in [-], in (0, 1]; NaN for a given μ.
    double residual = kNaN;            ///< f = W_r/W_c + ε_in² [-], (P2).
    double bracket_low = 0;            ///< Largest μ known to be too small; 0: none yet.
    double bracket_high = 0;           ///< Smallest μ known to be too large; 0: none yet.
    Update update = Update::kNothing;  ///< How μ was changed before the pass.
  };
  int episode = 1;                ///< Number of the episode, from 1.
  int number = 0;                 ///< Corrections made before the pass, ≥ 0.
  double start_time = 0;          ///< Start of the episode [s].
  bool accepted = false;          ///< Whether this pass is the one recorded.
  std::vector<Unknown> unknowns;  ///< In the order in which the cycles first appeared.
};

/// Samples of the accepted trajectory in time order, one row a sample:
///   t, then x, v of each body, then δ, δ̇, F, F_e of each contact, then ẍ of each body,
///   force on its body and energy of the spring of each support, and of the system, (B1):
///   ½Σmv², ΣU, energy of all supports, what is dissipated since 0, and load work since 0.
struct Samples {
  std::int64_t first = 0;      ///< Index of the first row in the trajectory, from 0.
  int columns = 0;             ///< SampleColumns of the scenario.
  std::vector<double> values;  ///< Row after row; [s], [m], [m/s], [m/s²], [N], [J].

  /// Number of rows.
  int rows() const { return columns == 0 ? 0 : static_cast<int>(values.size()) / columns; }
};

/// How far a run is.
struct Progress {
  double time = 0;              ///< Simulated time that is recorded [s].
  std::int64_t steps = 0;       ///< Steps tried so far, in all passes.
  std::int64_t cycles = 0;      ///< Cycles in the ledger so far.
  std::int64_t iterations = 0;  ///< Corrections of μ so far.
  /// What keeps a run of many steps busy, for people: contact, δ, λh, work; empty before.
  std::string busy_with = {};
};

/// How a run ended, and its balances.
struct Outcome {
  /// Why a run ended.
  enum class End {
    kFinished,      ///< The end time is reached.
    kStopped,       ///< The stop token asked.
    kNumeric,       ///< A value stopped being finite, or the step vanished.
    kBudgetSteps,   ///< SolverOptions::max_steps.
    kNotConverged,  ///< Only with SolverOptions::fail_if_not_converged.
  };
  End end = End::kFinished;        ///< Why the run ended.
  std::string message;             ///< Where and why, for every end but kFinished.
  double time = 0;                 ///< Simulated time reached [s].
  bool all_converged = true;       ///< No cycle is kNotConverged or kInfeasible.
  std::int64_t cut_cycles = 0;     ///< Cycles that the end of the run cuts: kCut and kUnfinished.
  std::vector<double> positions;   ///< At the end, or the last finite ones [m], for each body.
  std::vector<double> velocities;  ///< At the end, or the last finite ones [m/s], for each body.

  std::int64_t steps = 0;                ///< Steps tried, in all passes.
  std::int64_t evaluations = 0;          ///< Evaluations of the equations of motion.
  std::int64_t iterations = 0;           ///< Corrections of μ, in all episodes.
  std::int64_t episodes = 0;             ///< Episodes recorded.
  double worst_identity_residual = 0;    ///< Largest Cycle::identity_residual [-].
  double momentum_residual = 0;          ///< Relative miss of the momentum balance [-], (B2).
  double energy_residual = 0;            ///< Relative miss of the energy balance [-], (B1).
  double kinetic_energy = 0;             ///< ½Σmv² at the end [J].
  std::int64_t growths = 0;              ///< Growths of groups in the search.
  std::int64_t growths_no_progress = 0;  ///< Those with Growth::kNoProgress.
};

}  // namespace contact
