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
  Moves moves() const;

  Histogram wait_seconds{DecadeBounds(-3, 4)};  ///< From creation to the first start.
  Histogram run_seconds{DecadeBounds(-3, 4)};   ///< From the last start to the end.
  Histogram iterations{DecadeBounds(0, 2)};     ///< Of μ, one value a cycle.
  std::atomic<std::int64_t> steps = 0;          ///< Of integration, of the jobs that have ended.

 private:
  void Ended(const v1::Job& job);

  mutable Mutex mutex_;
  Moves moves_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace contact
