#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "contact/v1/job_service.pb.h"
#include "jobs/job/budget.h"
#include "jobs/job/errors.h"
#include "jobs/log/delivery_cursor.h"
#include "storage/records.h"

namespace contact {

/// The rules that job_service.proto gives for requests, each checked in one place.

/// Violations of everything in the request but the scenario.
std::vector<Violation> CheckCreate(const v1::CreateJobRequest& request,
                                   const RunBudget& max_budget = {});

/// What to ask the store; FIELD_INVALID if the request breaks a rule.
Result<JobQuery> ToQuery(const v1::ListJobsRequest& request);

/// Token of the page that starts after the job with this number; empty for 0.
std::string PageToken(std::int64_t number);

/// How a job is to be watched.
struct WatchRules {
  std::uint32_t kinds = 0;  ///< See KindBit. state_changed is among them.
  std::chrono::milliseconds bookmark_interval{0};
  DeliveryCursor::Rules delivery;
};
/// FIELD_INVALID.
Result<WatchRules> ToRules(const v1::WatchJobRequest& request);

/// How jobs are to be watched.
struct JobsRules {
  JobQuery filter;
  std::chrono::milliseconds bookmark_interval{0};
};
/// FIELD_INVALID.
Result<JobsRules> ToRules(const v1::WatchJobsRequest& request);

/// What GetSeries is to return of a trajectory.
struct SeriesSelection {
  std::vector<int> columns;  ///< Among those of the trajectory; the first is the time.
  double start_time = 0;     ///< [s], itself included.
  double end_time = 0;       ///< [s], itself included.
  std::size_t max_rows = 0;
  bool raw = false;  ///< Every sample; else thinned so that no peak is lost.
};
/// FIELD_INVALID; SERIES_TOO_LARGE if not even the fewest points would fit into an answer.
Result<SeriesSelection> ToSelection(const v1::GetSeriesRequest& request,
                                    const std::vector<v1::FrameChunk::Column>& channels);

}  // namespace contact
