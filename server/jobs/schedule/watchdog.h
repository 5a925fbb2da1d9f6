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
  struct Patience {
    std::chrono::milliseconds step;  ///< With a run that makes no step; 0: for ever.
    std::chrono::milliseconds stop;  ///< With one that was asked to stop and does nothing more.
  };

  explicit Watchdog(Time start) : start_(start), last_look_(start) {}

  /// True: the run does not hear, and is to be given up.
  bool Look(RunControl& control, Time now, const Patience& patience);

 private:
  const Time start_;
  Time last_look_;
  std::chrono::nanoseconds idle_{0};  ///< Time without a sign of life.
  std::int64_t signs_ = 0;
  bool stopping_ = false;
};

}  // namespace contact
