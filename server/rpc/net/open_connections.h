#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <map>
#include <string>

namespace contact {

/// The connections that gRPC has and their peers. gRPC closes them without a word, so the book is
/// put right by asking the system: a socket is still the same if its descriptor has its inode.
/// Not thread-safe.
class OpenConnections {
 public:
  using Time = std::chrono::steady_clock::time_point;

  void Add(int fd, const std::string& peer);
  /// Forgets those that are closed.
  void Sweep();
  /// Ends those that are left, as if their peers had left; gRPC will close them.
  void Cut();
  /// The same for those whose peers have taken nothing of what waits for them since `stall`, as far
  /// as earlier calls have seen it. To be called several times in that time.
  void CutStalled(Time now, std::chrono::milliseconds stall);

  std::size_t size() const { return sockets_.size(); }
  /// Of one peer.
  std::size_t CountOf(const std::string& peer) const;

 private:
  struct Socket {
    ino_t inode;
    std::string peer;
    int waiting = 0;  ///< Bytes that its peer had not taken,
    Time since = {};  ///< so many since then.
  };
  void Leave(const std::string& peer);

  std::map<int, Socket> sockets_;  ///< By descriptor.
  std::map<std::string, std::size_t> peers_;
};

}  // namespace contact
