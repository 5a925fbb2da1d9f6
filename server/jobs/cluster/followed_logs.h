#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/mutex.h"
#include "jobs/log/job_log.h"
#include "storage/shared_store.h"

namespace contact {

/// The logs that somebody watches here, of jobs that run anywhere: each knows how far its job is,
/// and holds no events, so that watchers read them from the store. Thread-safe.
class FollowedLogs {
 public:
  /// The log of a stored job that has not ended.
  std::shared_ptr<JobLog> Follow(const v1::Job& job);
  /// A job is there now. Positions may come in any order.
  void Advance(const LogPosition& position);
  /// True if somebody has the log of the job.
  bool Has(const std::string& name) { return Find(name) != nullptr; }
  /// Tells the watchers how far the run is.
  void SetProgress(const std::string& name, const v1::Event& progress);
  /// Names of the jobs whose logs somebody has.
  std::vector<std::string> names();

 private:
  /// The log, if somebody has it; else null.
  std::shared_ptr<JobLog> Find(const std::string& name);

  Mutex mutex_;
  /// May hold logs that are gone.
  std::map<std::string, std::weak_ptr<JobLog>> logs_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace contact
