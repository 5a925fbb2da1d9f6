#pragma once

#include <map>
#include <memory>
#include <string>

#include "base/mutex.h"

namespace contact {

/// Who calls, as the limits count: the address in the network without its port, such as
/// `ipv4:127.0.0.1`, from `ServerContext::peer()`. All clients of a socket file are one peer.
std::string PeerOf(const std::string& uri);

/// Counts what each peer has open. Thread-safe.
class PeerCounts : public std::enable_shared_from_this<PeerCounts> {
 public:
  using Lease = std::shared_ptr<const void>;

  /// Counts until the lease goes.
  Lease Enter(const std::string& peer);

  int Of(const std::string& peer) const;

 private:
  void Leave(const std::string& peer);

  mutable Mutex mutex_;
  std::map<std::string, int> open_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace contact
