#pragma once

#include <sys/types.h>

#include <cstddef>
#include <map>
#include <string>

namespace contact {

/// The connections that gRPC has and their peers. gRPC closes them without a word, so the book is
/// put right by asking the system: a socket is still the same if its descriptor has its inode.
/// Not thread-safe.
class OpenConnections {
 public:
  void Add(int fd, const std::string& peer);
  /// Forgets those that are closed.
  void Sweep();
  /// Ends those that are left, as if their peers had left; gRPC will close them.
  void Cut();

  std::size_t size() const { return sockets_.size(); }
  /// Of one peer.
  std::size_t CountOf(const std::string& peer) const;

 private:
  struct Socket {
    ino_t inode;
    std::string peer;
  };
  void Leave(const std::string& peer);

  std::map<int, Socket> sockets_;  ///< By descriptor.
  std::map<std::string, std::size_t> peers_;
};

}  // namespace contact
