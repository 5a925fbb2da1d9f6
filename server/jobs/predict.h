#pragma once

#include "contact/v1/job.pb.h"
#include "wire/scenario/scenario_codec.h"

namespace contact {

/// Adds to a valid job what only the answer to a `validate_only` request has: the estimate of the
/// run and advice on the scenario or sweep.
void Predict(const ScenarioLimits& limits, v1::Job* job);

}  // namespace contact
