#pragma once

#include <grpcpp/server_context.h>
#include <sys/socket.h>

#include <map>
#include <memory>
#include <string>

#include "base/mutex.h"

namespace contact {

/// The peer of a call, for limits: the network address without its port, such as `ipv4:127.0.0.1`.
/// `uri` is `ServerContext::peer()`. All clients of a socket file are one peer, `unix`.
std::string PeerOf(const std::string& uri);

/// The network address of a connection without its port; `unix` for one of a socket file.
std::string AddressOf(const sockaddr_storage& address);
/// The connection as gRPC calls it: `ipv4:127.0.0.1:5000`, `ipv6:%5B::1%5D:5000`, `unix:`.
std::string UriOf(const sockaddr_storage& address);

/// The metadata by which the gateway says from which connection a call comes, as UriOf.
inline constexpr char kPeerHeader[] = "x-contactd-peer";

/// Who makes a call: `ServerContext::peer()`; for a call from within the process, the connection
/// that the gateway names. Calls of a connection cannot name another.
std::string CallerUri(const grpc::ServerContextBase& context);

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
