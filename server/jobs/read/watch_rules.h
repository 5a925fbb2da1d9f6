#pragma once

#include <chrono>
#include <cstdint>

#include "contact/v1/job_service.pb.h"
#include "jobs/job/errors.h"
#include "jobs/log/delivery_cursor.h"
#include "storage/records.h"

namespace contact {

/// How a job is to be watched.
struct WatchRules {
  std::uint32_t kinds = 0;  ///< See KindBit. state_changed is among them.
  std::chrono::milliseconds bookmark_interval{0};
  DeliveryCursor::Rules delivery;
};
/// Reads the request; FIELD_INVALID if it breaks a rule of job_service.proto.
Result<WatchRules> ToRules(const v1::WatchJobRequest& request);

/// How jobs are to be watched.
struct JobsRules {
  JobQuery filter;
  std::chrono::milliseconds bookmark_interval{0};
};
/// Reads the request; FIELD_INVALID if it breaks a rule of job_service.proto.
Result<JobsRules> ToRules(const v1::WatchJobsRequest& request);

}  // namespace contact
