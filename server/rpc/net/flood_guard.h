#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/mutex.h"
#include "rpc/net/open_connections.h"

namespace contact {

/// Cuts connections that flood the server: those that have more calls open at once than the
/// server's HTTP/2 settings allow, which gRPC 1.51 does not enforce before a client has confirmed
/// them, those that take back hundreds in a second, and those that send far more bytes than their
/// calls need, such as headers without end, pings or settings. Clients of a socket file cannot be
/// told apart, and are not looked at. Thread-safe; owned by shared pointers.
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
  /// A call was answered, well or with an error.
  void Answered(const std::string& uri);
  /// A call of this connection was taken back before its end.
  void TakenBack(const std::string& uri, Time now);

  /// Looks at all open connections of the network. To be called many times a second. Gives memory
  /// back to the system after a cut and when the process has grown.
  void Look(const std::vector<Traffic>& all, Time now);

 private:
  /// What a connection does.
  struct Calls {
    int open = 0;
    /// Calls taken back since `since`.
    int taken_back = 0;
    Time since = {};
    /// True if a call was answered after the last look.
    bool answered = false;
    /// It was seen by the last look.
    bool there = false;
    /// At the last look that found a call answered, or the first one.
    Traffic then = {};
  };

  /// True if the connection has sent more since `then` than may come between two answers.
  static bool Floods(const Traffic& then, const Traffic& now);

  /// True if memory is to be given back now.
  bool IsTimeToTrim(Time now);
  /// Cuts a connection of the network, and logs it.
  void End(const std::string& uri, const char* why) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  /// Takes one from the open calls.
  void Leave(const std::string& uri);

  Mutex mutex_;
  Cut cut_ ABSL_GUARDED_BY(mutex_);
  /// Connections with open calls, and those that were open at the last look.
  std::map<std::string, Calls> calls_ ABSL_GUARDED_BY(mutex_);
  /// True if a connection was cut after the last look.
  bool some_cut_ ABSL_GUARDED_BY(mutex_) = false;
  /// Until then gRPC may let go of memory.
  Time cut_ends_ ABSL_GUARDED_BY(mutex_) = {};
  Time trimmed_ ABSL_GUARDED_BY(mutex_) = {};
  /// The least memory of the process since then [B].
  std::int64_t least_ ABSL_GUARDED_BY(mutex_) = std::numeric_limits<std::int64_t>::max();
};

}  // namespace contact
