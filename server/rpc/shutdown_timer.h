#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace contact {

/// Bounds the time that the shutdown of gRPC takes: while the timer lives, it calls `give_up` once,
/// `limit` after its construction. Destroying it ends the timer; a call that is under way is waited
/// for.
class ShutdownTimer {
 public:
  using Action = std::function<void()>;

  /// Starts the thread, named `shutdown-timer`, which runs the action.
  ShutdownTimer(std::chrono::milliseconds limit, Action give_up);

 private:
  std::jthread thread_;
};

}  // namespace contact
