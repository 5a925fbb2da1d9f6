#pragma once

#include <vector>

#include "contact/v1/event.pb.h"
#include "contact/v1/job.pb.h"
#include "simulation/model/ledger.h"
#include "simulation/model/scenario.h"

namespace contact {

/// Encode writes what a run reports as a message of the contract. `scenario` is the one that runs;
/// names of bodies and contacts come from it.

/// A pass through an episode.
v1::Iteration Encode(const Scenario& scenario, const Iteration& iteration);
/// Consecutive samples, column by column: the columns of Channels with values.
v1::FrameChunk Encode(const Scenario& scenario, const Samples& samples);
/// The progress of a run; the counts of cells stay 0.
v1::Progress Encode(const Scenario& scenario, const Progress& progress);

/// Fills convergence, final_bodies and summary of a job, except for summary.wall_time_s. The cycles
/// that the job has are those that are counted.
void EncodeOutcome(const Scenario& scenario, const Outcome& outcome, v1::Job* job);

}  // namespace contact
