#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "rpc/net/peer.h"

namespace contact {

/// What the system says of a connection.
struct Traffic {
  /// As gRPC calls it.
  std::string uri = {};
  /// Bytes that have come, and bytes that its peer has confirmed to have got.
  std::uint64_t received = 0, sent = 0;
};

/// The connections that gRPC has, by descriptor, with their peers. gRPC closes connections without
/// telling, so stale entries are found by comparing each descriptor's inode with the one that it
/// had when it was added. Not thread-safe.
class OpenConnections {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Adds the connection `fd` of `peer`, which gRPC calls `uri`. An entry of the same descriptor is
  /// stale and is replaced.
  void Add(int fd, const std::string& peer, const std::string& uri = "");

  /// Forgets the connections that gRPC has closed. Costs one system call for each entry.
  void ForgetClosed();

  /// Shuts down the connections that are open, as if their peers had left; gRPC then closes them.
  void Cut();
  /// The one with this uri.
  void Cut(const std::string& uri);

  /// Shuts down the connections whose peers have taken none of the bytes that wait for them for
  /// `stall`, as far as earlier calls have seen it. To be called several times within `stall`.
  void CutStalled(Time now, std::chrono::milliseconds stall);

  /// The traffic of each connection of the network that is open.
  std::vector<Traffic> Traffics() const;

  /// Number of entries, with those that gRPC has closed since ForgetClosed.
  std::size_t size() const { return sockets_.size(); }
  /// Number of entries of one peer, likewise.
  int CountOf(const std::string& peer) const { return peers_->Of(peer); }

 private:
  struct Socket {
    /// Inode of the descriptor, when it was added.
    ino_t inode;
    /// Counts the connection of the peer.
    PeerCounts::Lease lease;
    std::string uri;
    /// Bytes in the system's send queue when it was last looked at.
    int waiting = 0;
    /// When `waiting` was first seen with this value.
    Time since = {};
  };

  const std::shared_ptr<PeerCounts> peers_ = std::make_shared<PeerCounts>();
  /// By descriptor.
  std::map<int, Socket> sockets_;
};

}  // namespace contact
