#pragma once

#include <chrono>
#include <string>

namespace contact {

/// Clocks and identifiers, injected so that tests decide both.
class Clock {
 public:
  virtual ~Clock() = default;
  /// What time it is. May jump; only for people to read.
  virtual std::chrono::system_clock::time_point Now() const = 0;
  /// For durations: never jumps.
  virtual std::chrono::steady_clock::time_point Elapsed() const = 0;
};

class IdSource {
 public:
  virtual ~IdSource() = default;
  /// A job id that was never used before: lower-case letters and digits.
  virtual std::string NextJobId() = 0;
  /// A UUID.
  virtual std::string NextUid() = 0;
};

/// The real ones. Both are thread-safe and live as long as the process.
const Clock& SystemClock();
IdSource& RandomIds();

}  // namespace contact
