#pragma once

#include <cstdint>
#include <string>

#include "contact/v1/job_service.pb.h"
#include "jobs/job/errors.h"
#include "storage/records.h"

namespace contact {

/// The query of the store that answers the request; FIELD_INVALID if the request breaks a rule of
/// job_service.proto.
Result<JobQuery> ToQuery(const v1::ListJobsRequest& request);

/// The token of the page that starts after the job with this number; empty for 0.
std::string PageToken(std::int64_t number);

}  // namespace contact
