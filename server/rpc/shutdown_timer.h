#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <thread>

#include "base/mutex.h"

namespace contact {

/// Bounds the time that the shutdown of gRPC takes: while the timer lives, it calls `urge` once
/// after `patience`, and `give_up` once after `limit`, both counted from its construction.
/// Destroying it ends the timer; a call that is under way is waited for.
class ShutdownTimer {
 public:
  using Action = std::function<void()>;

  /// The actions run on the timer's thread. `patience` is at most `limit`.
  ShutdownTimer(std::chrono::milliseconds patience, Action urge, std::chrono::milliseconds limit,
                Action give_up);
  ~ShutdownTimer();
  ShutdownTimer(const ShutdownTimer&) = delete;
  ShutdownTimer& operator=(const ShutdownTimer&) = delete;

 private:
  /// Waits until `end`. True if the timer is destroyed before.
  bool DoneBy(std::chrono::steady_clock::time_point end);

  Mutex mutex_;
  std::condition_variable_any changed_;
  bool done_ ABSL_GUARDED_BY(mutex_) = false;
  std::thread thread_;  // Last: it uses all of the above.
};

}  // namespace contact
