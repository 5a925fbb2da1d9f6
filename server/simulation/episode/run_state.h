#pragma once

#include <cstdint>
#include <vector>

#include "simulation/model/ledger.h"
#include "simulation/motion/motion.h"

namespace contact {

/// What an episode knows of a cycle that begins after it, for the next one.
struct Guess {
  int contact = 0;
  int number = 1;                ///< Of the contact's cycles.
  double start_time = 0;         ///< Expected [s].
  double mu = 0;                 ///< The last one [N·s/mⁿ⁺¹],
  double start_mu = 0;           ///< the first, and
  double settled_mu = kNaN;      ///< the one when all in a window had converged; NaN before.
  double length = 0, speed = 0;  ///< See CycleHost::Factor.
};

/// All that a run needs to go on from an instant between two episodes as if it had never stopped.
struct RunState {
  State state;
  Outcome outcome;  ///< What is known of it so far: episodes, convergence, identity residual.
  std::int64_t cycles = 0;
  std::int64_t steps = 0;
  std::int64_t evaluations = 0;
  std::int64_t iterations = 0;
  double start_energy = 0, start_momentum = 0;
  double energy_scale = 0, momentum_scale = 0;
  std::vector<Guess> guesses;
  std::vector<bool> warned;  ///< Contacts of which a warning was given.
  std::vector<bool> missed;  ///< Laws of which a miss was told.
  Samples samples;           ///< Taken and not reported yet; `first` is theirs.
};

}  // namespace contact
