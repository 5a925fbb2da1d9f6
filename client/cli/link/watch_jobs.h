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
  virtual void OnJob(const v1::Job&) {}  ///< A job that is new, or has another state than before.
  virtual void OnGone(const std::string& /*name*/) {}  ///< A job that was told of was deleted.
  /// The connection was lost; another attempt follows after `pause`.
  virtual void OnLost(const std::string& /*why*/, std::chrono::milliseconds /*pause*/) {}
  virtual void OnTick() {}  ///< About ten times a second.
};

/// What WatchJobs follows, and for how long.
struct JobsWatchOptions {
  v1::WatchJobsRequest request;  ///< The filter.
  /// When to stop; never, if unset.
  std::optional<std::chrono::steady_clock::time_point> deadline;
  std::function<bool()> stopped = [] { return false; };  ///< Asked about ten times a second.
  Patience patience = {};                                ///< With a server that cannot be reached.
};

/// Follows the jobs of a filter across connections, until it is stopped or the deadline. After a
/// reconnection the observer hears only of changes meanwhile. Throws CallFailure as Watch does.
WatchEnd WatchJobs(Client& client, const JobsWatchOptions& options, JobsObserver& observer);

}  // namespace contact::cli
