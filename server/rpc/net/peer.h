#pragma once

#include <grpcpp/server_context.h>

#include <map>
#include <memory>
#include <string>

#include "base/mutex.h"

namespace contact {

/// The peer of a call, for limits: the network address without its port, such as `ipv4:127.0.0.1`.
/// `uri` is a connection as UriOf calls it. The clients of a socket file are a peer for each user
/// of the machine, such as `unix:1000`.
std::string PeerOf(const std::string& uri);

/// How the connection `fd` is called: `ipv4:127.0.0.1:5000`, `ipv6:%5B::1%5D:5000` as gRPC does,
/// and `unix:1000:7` for the seventh connection of a process to socket files, by the user 1000.
std::string UriOf(int fd);

/// The metadata by which the gateway says from which connection a call comes, as UriOf; and a name
/// in the client certificate of that connection, see CertificateRules, any number of times.
inline constexpr char kPeerHeader[] = "x-contactd-peer";
inline constexpr char kCertificateHeader[] = "x-contactd-certificate-bin";

/// Who makes a call: the connection that the gateway names, `unknown` for a call from elsewhere in
/// the process.
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
