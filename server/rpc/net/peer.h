#pragma once

#include <map>
#include <memory>
#include <string>

#include "base/mutex.h"

namespace contact {

/// The peer of a call, for limits: the network address without its port, such as `ipv4:127.0.0.1`.
/// `uri` is `ServerContext::peer()`. All clients of a socket file are one peer, `unix`.
std::string PeerOf(const std::string& uri);

/// Counts what each peer has open, such as streams. Thread-safe; owned by shared pointers.
class PeerCounts : public std::enable_shared_from_this<PeerCounts> {
 public:
  /// Keeps one count of a peer until it is destroyed. Keeps the counts alive, too.
  using Lease = std::shared_ptr<const void>;

  /// Adds one to the peer's count.
  Lease Enter(const std::string& peer);

  /// The peer's count.
  int Of(const std::string& peer) const;

 private:
  /// Takes one from the peer's count.
  void Leave(const std::string& peer);

  mutable Mutex mutex_;
  /// Counts by peer; none is 0.
  std::map<std::string, int> open_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace contact
