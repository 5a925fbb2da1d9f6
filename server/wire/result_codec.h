#pragma once

#include <vector>

#include "contact/v1/event.pb.h"
#include "contact/v1/job.pb.h"
#include "simulation/model/ledger.h"
#include "simulation/model/scenario.h"

namespace contact {

/// Writes what a run reports as messages of the contract. Names come from the scenario.

v1::Cycle Encode(const Scenario& scenario, const Cycle& cycle);
v1::Iteration Encode(const Scenario& scenario, const Iteration& iteration);
v1::FrameChunk Encode(const Scenario& scenario, const Samples& samples);
v1::Progress Encode(const Scenario& scenario, const Progress& progress);

/// The columns of the scenario's frame chunks, without values: `time`, then those of each body and
/// of each contact.
std::vector<v1::FrameChunk::Column> Channels(const Scenario& scenario);

/// Fills convergence, final_bodies and summary (but for wall_time_s) of a job.
void EncodeOutcome(const Scenario& scenario, const Outcome& outcome, v1::Job* job);

}  // namespace contact
