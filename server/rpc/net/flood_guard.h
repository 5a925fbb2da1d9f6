#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "base/mutex.h"

namespace contact {

/// Cuts connections that flood the server with calls: those that have more open at once than the
/// server's HTTP/2 settings allow, which gRPC 1.51 does not enforce before a client has confirmed
/// them, and those that take back hundreds in a second. Clients of a socket file cannot be told
/// apart, and are not looked at. Thread-safe; owned by shared pointers.
class FloodGuard : public std::enable_shared_from_this<FloodGuard> {
 public:
  /// Cuts the connection of `ServerContext::peer()`.
  using Cut = std::function<void(const std::string& uri)>;
  using Time = std::chrono::steady_clock::time_point;

  /// Counts an open call until it is destroyed, and keeps the guard alive.
  using Lease = std::shared_ptr<const void>;

  /// How connections are cut from now on; empty: not at all. Waits for one that is being cut.
  void SetCut(Cut cut);

  /// A call of this connection has begun.
  Lease Enter(const std::string& uri);
  /// A call of this connection was taken back before its end.
  void TakenBack(const std::string& uri, Time now);

 private:
  /// What a connection does.
  struct Calls {
    int open = 0;
    /// Calls taken back since `since`.
    int taken_back = 0;
    Time since = {};
  };

  /// Cuts a connection of the network, and logs it.
  void End(const std::string& uri, const char* why) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  /// Takes one from the open calls.
  void Leave(const std::string& uri);

  Mutex mutex_;
  Cut cut_ ABSL_GUARDED_BY(mutex_);
  /// Connections with open calls, and with such as were taken back of late.
  std::map<std::string, Calls> calls_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace contact
