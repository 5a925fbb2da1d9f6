#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "cli/link/client.h"
#include "cli/link/reconnection.h"
#include "cli/link/watch.h"

namespace contact::cli {

/// Hears what becomes of the jobs of a filter, on the thread that watches.
class JobsObserver {
 public:
  virtual ~JobsObserver() = default;
  virtual void OnJob(const v1::Job&) {}  ///< A job that is new, or has another state than before.
  virtual void OnGone(const std::string& /*name*/) {}  ///< One that was heard of, and is no more.
  virtual void OnLost(const std::string& /*why*/, std::chrono::milliseconds /*pause*/) {}
};

struct JobsWatchOptions {
  v1::WatchJobsRequest request;
  std::optional<std::chrono::steady_clock::time_point> deadline;
  std::function<bool()> stopped = [] { return false; };  ///< Asked about ten times a second.
  Patience patience = {};
};

/// Follows the jobs of a filter across connections, until it is stopped or the time is up. After a
/// reconnection only what has changed meanwhile is told. Throws CallFailure as Watch does.
WatchEnd WatchJobs(Client& client, const JobsWatchOptions& options, JobsObserver& observer);

}  // namespace contact::cli
