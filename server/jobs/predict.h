#pragma once

#include "contact/v1/job.pb.h"
#include "wire/scenario_codec.h"

namespace contact {

/// Adds to a valid job what the answer to `validate_only` has besides: estimate and advice.
void Predict(const ScenarioLimits& limits, v1::Job* job);

}  // namespace contact
