#pragma once

#include "contact/v1/job_service.pb.h"
#include "jobs/job/errors.h"
#include "storage/records.h"

namespace contact {

/// The change of the store that the request asks for; FIELD_INVALID if the request breaks rules of
/// job_service.proto, all of which it lists.
Result<JobRemark> ToRemark(const v1::UpdateJobRequest& request);

}  // namespace contact
