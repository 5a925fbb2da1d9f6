#pragma once

#include <string>

#include "cli/base/style.h"
#include "contact/v1/job_service.pb.h"

namespace contact::cli {

/// A table of what a job will probably take beside what it may take: the least of the server's
/// limits, the budget of the job and its `max_steps`. `job` is the answer to `validate_only`. Empty
/// if the answer has no estimate.
std::string RenderEstimate(const v1::Job& job, const v1::ServerLimits& limits, const Style& style);

}  // namespace contact::cli
