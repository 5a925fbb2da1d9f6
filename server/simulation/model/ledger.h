#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "simulation/model/scenario.h"

namespace contact {

/// One compression of one contact and the restitution that follows it. Letters: README.md.
struct Cycle {
  enum class Kind { kCollision, kNirv };
  enum class End { kSeparation, kNonSeparation, kRunEnd };
  enum class Status { kConverged, kGivenLaw, kInfeasible, kSettled, kNotConverged };

  int contact = 0;  ///< Index in Scenario::contacts.
  int number = 1;   ///< Place among the cycles of its contact, from 1.
  int episode = 1;  ///< Cycles of one episode are solved together.
  Kind kind = Kind::kCollision;
  End end = End::kRunEnd;
  Status status = Status::kNotConverged;
  int iterations = 0;  ///< Corrections of μ made for the episode.

  double start_time = 0;              ///< t_s [s].
  double turn_time = kNaN;            ///< t_m [s]; NaN if the run ended before.
  double end_time = 0;                ///< t_o [s].
  double start_deformation = 0;       ///< δ_s [m].
  double max_deformation = 0;         ///< δ_m [m].
  double end_deformation = 0;         ///< δ_o [m].
  double approach_velocity = 0;       ///< δ̇⁻ [m/s], ≥ 0.
  double separation_velocity = 0;     ///< δ̇⁺ [m/s], ≤ 0.
  double mu = 0;                      ///< μ [N·s/mⁿ⁺¹].
  double work_compression = 0;        ///< W_c [J].
  double work_restitution = 0;        ///< W_r [J], ≤ 0.
  double dissipated_compression = 0;  ///< D_c [J].
  double dissipated_restitution = 0;  ///< D_r [J].
  double external_compression = 0;    ///< E_c, work of F_e [J].
  double external_restitution = 0;    ///< E_r [J].
  double restitution_in = kNaN;       ///< ε_in; NaN for a given μ.
  double restitution_out = kNaN;      ///< ε_out = √(−W_r/W_c).
  double peak_force = 0;              ///< [N].
  double tension_time = 0;            ///< Time for which F < 0 [s].
  double identity_residual = 0;       ///< |(W4)| / W_c.
};

/// One pass through an episode with one set of μ.
struct Iteration {
  enum class Update {
    kNothing,
    kNewton,
    kDampedNewton,
    kBisection,
    kZero,
    kPaperNewton,  ///< Paper (29).
    kPaperRatio,   ///< Paper (31).
    kBracketing,   ///< Doubling or halving in search of a bracket.
  };
  struct Unknown {
    int contact = 0;
    int number = 1;  ///< Place among the cycles of its contact.
    double mu = 0;
    double restitution_out = kNaN;
    double restitution_in = kNaN;
    double residual = kNaN;   ///< f = W_r/W_c + ε_in².
    double bracket_low = 0;   ///< 0: none yet.
    double bracket_high = 0;  ///< 0: none yet.
    Update update = Update::kNothing;
  };
  int episode = 1;
  int number = 0;  ///< Corrections made so far.
  double start_time = 0;
  bool accepted = false;
  std::vector<Unknown> unknowns;
};

/// Samples of the accepted trajectory in time order, one row a sample:
///   t, then x, v of each body, then δ, δ̇, F, F_e of each contact.
struct Samples {
  std::int64_t first = 0;  ///< Index of the first row in the trajectory.
  int columns = 0;         ///< 1 + 2·bodies + 4·contacts.
  std::vector<double> values;

  int rows() const { return columns == 0 ? 0 : static_cast<int>(values.size()) / columns; }
};

struct Progress {
  double time = 0;
  std::int64_t steps = 0;
  std::int64_t cycles = 0;
  std::int64_t iterations = 0;
};

/// How a run ended, and its balances.
struct Outcome {
  enum class End {
    kFinished,
    kStopped,       ///< The stop token asked.
    kNumeric,       ///< A value stopped being finite, or the step vanished.
    kBudgetSteps,   ///< SolverOptions::max_steps.
    kNotConverged,  ///< Only with SolverOptions::fail_if_not_converged.
  };
  End end = End::kFinished;
  std::string message;  ///< Where and why, for every end but kFinished.
  double time = 0;      ///< Simulated time reached [s].
  bool all_converged = true;
  std::vector<double> positions;   ///< At the end [m]; the last good ones of a run gone wrong.
  std::vector<double> velocities;  ///< [m/s].

  std::int64_t steps = 0;
  std::int64_t evaluations = 0;
  std::int64_t iterations = 0;
  std::int64_t episodes = 0;
  double worst_identity_residual = 0;
  double momentum_residual = 0;
  double energy_residual = 0;
  double kinetic_energy = 0;
};

}  // namespace contact
