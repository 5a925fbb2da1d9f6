#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "cli/link/client.h"
#include "cli/link/reconnection.h"
#include "cli/link/watch.h"

namespace contact::cli {

/// Receives what happens to the jobs of a filter, on the thread that called WatchJobs.
class JobsObserver {
 public:
  virtual ~JobsObserver() = default;
  /// A job that is new, or has another state or attempt than before.
  virtual void OnJob(const v1::Job&) {}
  /// A job that OnJob has told of was deleted.
  virtual void OnGone(const std::string& /*name*/) {}
  /// As those of WatchObserver.
  virtual void OnLost(const std::string& /*why*/) {}
  virtual void OnRegained() {}
  /// Called about ten times a second.
  virtual void OnTick() {}
};

/// What WatchJobs follows, and for how long.
struct JobsWatchOptions {
  /// The filter.
  v1::WatchJobsRequest request;
  /// When to stop; never, if unset.
  std::optional<std::chrono::steady_clock::time_point> deadline;
  /// Asked about ten times a second; true ends the watch.
  std::function<bool()> stopped = [] { return false; };
  /// With a server that cannot be reached.
  Patience patience = {};
};

/// Follows the jobs of a filter across connections, until it is stopped or the deadline. After a
/// reconnection the observer hears only of changes meanwhile. Throws CallFailure as Watch does.
WatchEnd WatchJobs(Client& client, const JobsWatchOptions& options, JobsObserver& observer);

}  // namespace contact::cli
