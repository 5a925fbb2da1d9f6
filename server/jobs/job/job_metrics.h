#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "base/histogram.h"
#include "base/mutex.h"
#include "contact/v1/job.pb.h"

namespace contact {

/// What jobs have done since the start of the process. Thread-safe.
class JobMetrics {
 public:
  /// Counts a job that has just gone from a state to the one it is in now.
  void Moved(v1::Job::State from, const v1::Job& job);

  /// How often a job came into a state, by state and reason.
  using Moves = std::map<std::pair<v1::Job::State, std::string>, std::int64_t>;
  /// What Moved has counted so far.
  Moves moves() const;

  /// Time from the creation of a job to its first start, in seconds.
  Histogram wait_seconds{DecadeBounds(-3, 4)};
  /// Time from the last start of a job to its end, in seconds.
  Histogram run_seconds{DecadeBounds(-3, 4)};
  /// Iterations of μ, one value for each cycle of the jobs that have ended.
  Histogram iterations{DecadeBounds(0, 2)};
  /// Integration steps of the jobs that have ended.
  std::atomic<std::int64_t> steps = 0;
  /// How often a group of cycles took in its neighbour, in the jobs that have ended.
  std::atomic<std::int64_t> growths = 0;

 private:
  /// Counts what a job that has just ended has taken.
  void Ended(const v1::Job& job);

  mutable Mutex mutex_;
  Moves moves_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace contact
