#pragma once

#include "contact/v1/job.pb.h"
#include "wire/sweep_codec.h"

namespace contact {

/// What a run will probably take: see Estimate in job.proto. Does not solve anything.
v1::Estimate EstimateRun(const Scenario& scenario);

/// The same for all cells of a sweep, as if each were its first.
v1::Estimate EstimateSweep(const v1::Sweep& sweep, const DecodedSweep& plan);

}  // namespace contact
