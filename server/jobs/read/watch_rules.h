#pragma once

#include <chrono>
#include <cstdint>

#include "contact/v1/job_service.pb.h"
#include "jobs/job/errors.h"
#include "jobs/log/delivery_cursor.h"
#include "jobs/log/jobs_cursor.h"

namespace contact {

/// How a job is to be watched.
struct WatchRules {
  /// See KindBit. state_changed is among them.
  std::uint32_t kinds = 0;
  /// Longest time without a sequence to resume from.
  std::chrono::milliseconds bookmark_interval{0};
  /// Which frame chunks are left out.
  DeliveryCursor::Rules delivery;
};
/// Reads the request; FIELD_INVALID if it breaks a rule of job_service.proto.
Result<WatchRules> ToRules(const v1::WatchJobRequest& request);

/// Reads the request; FIELD_INVALID if it breaks a rule of job_service.proto.
Result<JobsCursor::Rules> ToRules(const v1::WatchJobsRequest& request);

}  // namespace contact
