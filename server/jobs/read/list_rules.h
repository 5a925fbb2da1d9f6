#pragma once

#include <cstdint>

#include "contact/v1/job_service.pb.h"
#include "jobs/job/errors.h"
#include "storage/records.h"

namespace contact {

/// The query of the store that answers the request; FIELD_INVALID if the request breaks a rule of
/// job_service.proto. `before`: see JobQuery, as PageTokens::Open tells it of the request's token.
Result<JobQuery> ToQuery(const v1::ListJobsRequest& request, std::int64_t before = 0);

}  // namespace contact
