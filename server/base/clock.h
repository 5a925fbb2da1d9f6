#pragma once

#include <chrono>

namespace contact {

/// The time, injected so that tests decide it. Thread-safe.
class Clock {
 public:
  virtual ~Clock() = default;

  /// The date and time of day, UTC. May jump when the system's clock is set; only for people to
  /// read.
  virtual std::chrono::system_clock::time_point Now() const = 0;

  /// Time since an arbitrary start. Never jumps; for measuring durations and for deadlines.
  virtual std::chrono::steady_clock::time_point Elapsed() const = 0;
};

/// The clock of the operating system. Lives as long as the process.
const Clock& SystemClock();

}  // namespace contact
