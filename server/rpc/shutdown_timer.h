#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace contact {

/// Bounds the time that the shutdown of gRPC takes: while the timer lives, it calls `urge` once
/// after `patience`, and `give_up` once after `limit`, both counted from its construction.
/// Destroying it ends the timer; a call that is under way is waited for.
class ShutdownTimer {
 public:
  using Action = std::function<void()>;

  /// Starts the thread, named `shutdown-timer`. The actions run on the timer's thread. `patience`
  /// is at most `limit`.
  ShutdownTimer(std::chrono::milliseconds patience, Action urge, std::chrono::milliseconds limit,
                Action give_up);

 private:
  std::jthread thread_;
};

}  // namespace contact
