#pragma once

#include <chrono>
#include <cstdint>

#include "jobs/run/run_control.h"

namespace contact {

/// Watches over one attempt of a job: looks at it now and then, and stops it when its wall time is
/// spent or when it makes no step any more. Not thread-safe.
class Watchdog {
 public:
  using Time = std::chrono::steady_clock::time_point;
  /// What a run may take.
  struct Patience {
    /// Longest time without a step before the run is stopped; 0: any time.
    std::chrono::milliseconds step;
    /// Longest time without a sign of life after the run was asked to stop.
    std::chrono::milliseconds stop;
  };

  /// The run begins at `start`.
  explicit Watchdog(Time start) : last_look_(start) {}

  /// Looks at the run, and stops it if its time is spent. True: the run does not react to a stop,
  /// and is to be given up.
  bool Look(RunControl& control, Time now, const Patience& patience);

 private:
  Time last_look_;
  /// Wall time without that in which the run waited for its turn.
  std::chrono::nanoseconds used_{0};
  /// Time without a sign of life, as far as the process itself was running.
  std::chrono::nanoseconds idle_{0};
  /// RunControl::signs at the last look.
  std::int64_t signs_ = 0;
  /// RunControl::stopping at the last look.
  bool stopping_ = false;
};

}  // namespace contact
