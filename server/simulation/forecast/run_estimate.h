#pragma once

#include "simulation/model/scenario.h"

namespace contact {

/// What a run will probably take, from its scenario alone. Nothing is solved: cycles are counted
/// from the first meetings of contacts (first_meeting.h), steps and seconds from measured averages.
struct RunEstimate {
  double steps = 0;           ///< Integration steps of all passes.
  double samples = 0;         ///< Rows of the trajectory; exact.
  double sample_bytes = 0;    ///< Of these rows as events, with the headers of their chunks [byte].
  double ledger_bytes = 0;    ///< Of cycles, iterations and states of the job as events [byte].
  double memory_bytes = 0;    ///< Of the solver, a chunk of samples and the ledger [byte].
  double sample_seconds = 0;  ///< To interpolate, encode and store the samples [s].
  double solve_seconds = 0;   ///< Of everything else, in a release build on one core [s].
};

/// The estimate for one run.
RunEstimate EstimateRunOf(const Scenario& scenario);

}  // namespace contact
