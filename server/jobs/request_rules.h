#pragma once

#include <string>
#include <vector>

#include "contact/v1/job_service.pb.h"
#include "jobs/error.h"
#include "storage/records.h"

namespace contact {

/// The rules that job_service.proto gives for requests, each checked in one place.

/// Violations of everything in the request but the scenario.
std::vector<Violation> CheckCreate(const v1::CreateJobRequest& request);

/// What to ask the store; FIELD_INVALID if the request breaks a rule.
Result<JobQuery> ToQuery(const v1::ListJobsRequest& request);

/// Token of the page that starts after the job with this number; empty for 0.
std::string PageToken(std::int64_t number);

/// The set of kinds, state_changed among them; all if there are none. FIELD_INVALID: no such kind.
Result<std::uint32_t> KindSet(const std::vector<std::string>& kinds);

}  // namespace contact
