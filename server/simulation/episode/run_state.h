#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "simulation/episode/unknown.h"
#include "simulation/model/ledger.h"
#include "simulation/motion/state.h"

namespace contact {

struct ClusterState;

/// An instant at which a channel of Scenario::turning_channels turns: no longer grows or falls.
struct Turn {
  double time = 0;   ///< [s].
  int channel = 0;   ///< From 0.
  double value = 0;  ///< [N], [m] or [m/s].
};

/// The least and the largest turn of a channel since the last sample.
struct Extremes {
  /// The whole sample at the turn, without its time.
  struct Row {
    Turn turn;
    std::vector<double> values;
  };
  Row low, high;
  int turns = 0;     ///< Instants at which it turned.
  double scale = 0;  ///< Largest |value| of a turn since t = 0.
};

/// How far the trajectory is recorded.
struct Sampling {
  Samples pending;             ///< Taken and not reported yet; `first` is theirs.
  std::int64_t regular = 0;    ///< Samples at multiples of the interval so far.
  std::int64_t in_cycles = 0;  ///< Samples because of cycles so far.
  double last = 0;             ///< Time of the last sample [s].
  std::int64_t due = 0;        ///< Steps of the run at which `pending` is handed out, full or not.
  std::vector<Extremes> extremes;  ///< Since the last sample, of each turning channel.
};

/// When the rest that follows a group ends.
struct RestEnd {
  GroupId before;
  double time = 0;  ///< [s].
};

/// All that a run needs to go on from an instant between two episodes as if it had never stopped.
struct RunState {
  State state;
  Outcome outcome;  ///< What is known of it so far: episodes, convergence, identity residual.
  std::int64_t cycles = 0;
  std::int64_t steps = 0;
  std::int64_t evaluations = 0;
  std::int64_t iterations = 0;
  std::int64_t growths = 0, growths_no_progress = 0;
  double start_energy = 0, start_momentum = 0;
  double energy_scale = 0, momentum_scale = 0;
  double solved_until = 0;         ///< All that begins before has its answer [s].
  double record_until = kNever;    ///< The instant up to which that may be recorded [s].
  bool finely = false;             ///< That has its answer with the finest tolerance.
  double cut_since = kNever;       ///< Groups::cut_since.
  std::vector<Unknown> unknowns;   ///< What is known of groups that begin later.
  std::vector<RestEnd> rest_ends;  ///< Groups::rest_ends.
  std::vector<bool> warned;        ///< Contacts of which a warning was given.
  std::vector<bool> missed;        ///< Laws of which a miss was told.
  std::vector<bool> unproven;      ///< Contacts of which it was told that a row fails its proof.
  Sampling sampling;
  /// Of a run in clusters, of which `state` has the time and the contacts; else null.
  std::shared_ptr<const ClusterState> clusters;
};

}  // namespace contact
