#pragma once

#include <string>

#include "cli/base/style.h"
#include "contact/v1/job_service.pb.h"

namespace contact::cli {

/// What a job will probably take, beside what it may: the server's limits, or a budget or
/// `max_steps` of its own. `job` is the answer to `validate_only`; empty for a server that
/// estimates nothing.
std::string RenderEstimate(const v1::Job& job, const v1::ServerLimits& limits, const Style& style);

}  // namespace contact::cli
