#pragma once

#include <chrono>
#include <filesystem>

namespace contact {

class Clock;

/// The time by which ended jobs grow old: the wall clock, but never more than the time that the
/// server has seen pass, so that a clock that jumps deletes nothing. Follows corrections of up to
/// an hour; of the time for which no server ran a day counts. Used by one thread.
class RetentionClock {
 public:
  using Time = std::chrono::system_clock::time_point;

  /// `file` keeps the time for the next start; empty: nothing does. `clock` outlives this.
  RetentionClock(const Clock& clock, std::filesystem::path file);

  /// The time now. Stores it, and logs when the wall clock runs away from it.
  Time Now();

 private:
  /// Says once that the wall clock is ahead by so much.
  void Tell(std::chrono::duration<double> ahead);

  const Clock& clock_;
  const std::filesystem::path file_;
  /// The time that has passed, as a date.
  Time seen_;
  /// Reading of the monotonic clock that belongs to it.
  std::chrono::steady_clock::time_point elapsed_;
  /// True while the wall clock is more than an hour ahead.
  bool told_ = false;
};

}  // namespace contact
