#pragma once

#include <grpcpp/channel.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "gateway/options.h"
#include "rpc/net/connection_acceptor.h"

namespace contact {

/// Serves HTTP/1.1: calls of the gRPC server by the protocols Connect and gRPC-Web, the pages
/// `/metrics`, `/healthz` and `/readyz`, and the dashboard. Calls enter the gRPC server as those of
/// native clients do, and so meet the same checks and limits; they are told the client's address.
class Gateway {
 public:
  /// Serves those who come to the listener. `channel` leads into the gRPC server.
  Gateway(Listener listener, const std::shared_ptr<grpc::Channel>& channel, GatewayOptions options);

  /// Cuts all connections and waits until their calls have ended.
  ~Gateway();
  Gateway(const Gateway&) = delete;
  Gateway& operator=(const Gateway&) = delete;

  /// Numbers of connections that are open, and of those refused since the start.
  std::size_t connections() const;
  std::int64_t refused_connections() const;

  /// Accepts no more connections, and refuses requests with SERVER_DRAINING. Waits until those that
  /// came before are answered, for at most `grace`. The gRPC server outlives the gateway.
  void Finish(std::chrono::milliseconds grace);

 private:
  class Threads;

  /// Serve the connections.
  std::unique_ptr<Threads> threads_;
  std::unique_ptr<ConnectionAcceptor> acceptor_;  // Hands connections to threads_.
};

}  // namespace contact
