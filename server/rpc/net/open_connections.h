#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <map>
#include <string>

namespace contact {

/// The connections that gRPC has, by descriptor, with their peers. gRPC closes connections without
/// telling, so stale entries are found by comparing each descriptor's inode with the one that it
/// had when it was added. Not thread-safe.
class OpenConnections {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Adds the connection `fd` of `peer`. An entry of the same descriptor is stale and is replaced.
  void Add(int fd, const std::string& peer);

  /// Forgets the connections that gRPC has closed. Costs one system call for each entry.
  void ForgetClosed();

  /// Shuts down the connections that are open, as if their peers had left; gRPC then closes them.
  void Cut();

  /// Shuts down the connections whose peers have taken none of the bytes that wait for them for
  /// `stall`, as far as earlier calls have seen it. To be called several times within `stall`.
  void CutStalled(Time now, std::chrono::milliseconds stall);

  /// Number of entries, with those that gRPC has closed since ForgetClosed.
  std::size_t size() const { return sockets_.size(); }
  /// Number of entries of one peer, likewise.
  std::size_t CountOf(const std::string& peer) const;

 private:
  struct Socket {
    ino_t inode;       ///< Of the descriptor, when it was added.
    std::string peer;  ///< As in peers_.
    int waiting = 0;   ///< Bytes in the system's send queue when it was last looked at.
    Time since = {};   ///< When `waiting` was first seen with this value.
  };

  /// Takes one connection from the peer's count.
  void Leave(const std::string& peer);

  std::map<int, Socket> sockets_;             ///< By descriptor.
  std::map<std::string, std::size_t> peers_;  ///< Number of connections by peer; never 0.
};

}  // namespace contact
