#pragma once

#include <cstdint>

#include "contact/v1/job.pb.h"
#include "wire/sweep/sweep_codec.h"

namespace contact {

/// What a run will probably take, as simulation/forecast/run_estimate.h finds it; see Estimate in
/// job.proto. Counts beyond 9e18 and durations beyond 3e11 s are cut to these.
v1::Estimate EstimateRun(const Scenario& scenario);

/// Bytes of memory that a worker needs for a run or sweep before it has a ledger, which grows with
/// the cycles.
std::int64_t FixedMemory(const Scenario& scenario);
std::int64_t FixedMemory(const v1::Sweep& sweep, const DecodedSweep& plan);

/// What a sweep will probably take, as if each cell were like the first. Trajectories count for the
/// cells that keep theirs.
v1::Estimate EstimateSweep(const v1::Sweep& sweep, const DecodedSweep& plan);

}  // namespace contact
