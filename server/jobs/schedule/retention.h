#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "contact/v1/job.pb.h"
#include "jobs/job/job_options.h"
#include "jobs/schedule/retention_clock.h"

namespace contact {

class Clock;
class JobFeed;
class Store;

using WallTime = std::chrono::system_clock::time_point;

/// When an ended job is too old to be kept; none: never, or it has not ended.
std::optional<WallTime> ExpiryOf(const v1::Job& job, const RetentionLimits& limits);

/// True if the frame chunks of an ended job are not kept any more.
bool IsToCompact(const v1::Job& job, WallTime now, const RetentionLimits& limits);

/// Sets `expire_time` of an ended job that is not kept for ever.
void SetExpireTime(const RetentionLimits& limits, v1::Job* job);

/// What decides how long an ended job is kept.
struct EndedJob {
  std::string name;
  /// See ExpiryOf.
  std::optional<WallTime> expiry;
  /// What it takes in the store.
  std::int64_t bytes = 0;
  /// See IsToCompact.
  bool to_compact = false;
  /// True if the job itself says how long it is kept.
  bool asked = false;
};
/// Names of the jobs that are not kept any more. `jobs`: all that have ended, oldest end first. Of
/// those that the server alone finds too old, a tenth or a few; the others go next time.
std::vector<std::string> Expired(const std::vector<EndedJob>& jobs, WallTime now,
                                 const RetentionLimits& limits);

/// Deletes ended jobs that are not kept any more, and compacts others, once started each minute on
/// a thread of its own. Reads and deletes little at a time, so that the store serves others in
/// between.
class Retention {
 public:
  /// All outlive it.
  Retention(Store& store, const Clock& clock, RetentionLimits limits, JobFeed& feed);
  ~Retention();

  /// Starts the thread, named `retention`. Once only.
  void Start();
  /// Deletes and compacts what is due now; waits for it. Returns how many jobs were deleted. By one
  /// thread: the one that Start starts, if any.
  int Purge();
  /// Ends the thread. Idempotent; by one thread.
  void Stop();

 private:
  /// Deletes those that are due. Returns their number.
  int Delete(const std::vector<EndedJob>& jobs, WallTime now);
  /// Drops the frame chunks of those that are to be compacted.
  void Compact(const std::vector<EndedJob>& jobs);
  /// True once Stop was called: what is due can wait for the next start.
  bool stopped() const { return stop_.stop_requested(); }
  /// All ended jobs, oldest end first; fewer if the store fails.
  std::vector<EndedJob> ListEnded(WallTime now);

  Store& store_;
  /// Of whoever calls Purge.
  RetentionClock clock_;
  const RetentionLimits limits_;
  JobFeed& feed_;
  std::stop_source stop_;
  std::thread thread_;  // Last: it uses all of the above.
};

}  // namespace contact
