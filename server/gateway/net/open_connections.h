#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <string>

#include "base/mutex.h"
#include "rpc/net/connection_limits.h"
#include "rpc/net/peer.h"

namespace contact::gateway {

/// Counts the connections that are open, in all and by peer. Thread-safe; owned by shared pointers.
class OpenConnections : public std::enable_shared_from_this<OpenConnections> {
 public:
  /// One connection until it goes.
  using Lease = std::shared_ptr<const void>;

  explicit OpenConnections(ConnectionLimits limits) : limits_(limits) {}

  /// Null if there are too many, of the peer or in all.
  Lease Enter(const std::string& peer);

  /// Tells a connection that the server ends: that it is to take no more requests, then that it is
  /// cut. May be called by any thread; must not wait, nor use this.
  using Tell = std::function<void(bool cut)>;
  /// Has the connection told until the lease goes; at once if the others were told already.
  Lease Register(Tell tell);
  void TellAll(bool cut);

  /// Numbers of connections that are open, and of those refused since the start.
  std::size_t open() const;
  std::int64_t refused() const;

  /// Waits until none is open.
  void AwaitNone();

 private:
  void Left();

  const ConnectionLimits limits_;
  const std::shared_ptr<PeerCounts> peers_ = std::make_shared<PeerCounts>();
  mutable Mutex mutex_;
  std::condition_variable_any left_;
  std::size_t open_ ABSL_GUARDED_BY(mutex_) = 0;
  std::int64_t refused_ ABSL_GUARDED_BY(mutex_) = 0;
  std::list<Tell> told_ ABSL_GUARDED_BY(mutex_);
  bool draining_ ABSL_GUARDED_BY(mutex_) = false;
  bool cut_ ABSL_GUARDED_BY(mutex_) = false;
};

}  // namespace contact::gateway
