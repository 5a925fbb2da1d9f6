#pragma once

#include <grpcpp/channel.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "gateway/origin.h"
#include "rpc/net/connection_acceptor.h"

namespace contact {

/// Settings of the gateway.
struct GatewayOptions {
  gateway::OriginRules rules = {};
  /// Files of the dashboard; empty: none.
  std::filesystem::path web_dir = {};
  /// Largest body of a request [B].
  std::size_t max_body_bytes = 2 << 20;
  ConnectionLimits connections = {.in_all = 1024, .per_peer = 1024};
  /// A client that takes nothing for this time is dropped.
  std::chrono::milliseconds stall{30'000};
  /// The text of `/metrics`. Empty: it is not served.
  std::function<std::string()> metrics = {};
};

/// Serves HTTP/1.1: calls of the gRPC server by the protocols Connect and gRPC-Web, the pages
/// `/metrics`, `/healthz` and `/readyz`, and the dashboard. Calls enter the gRPC server as those of
/// native clients do, and so meet the same checks and limits; they are told the client's address.
class Gateway {
 public:
  /// Listens on `HOST:PORT` or `unix:PATH`, and serves. `channel` leads into the gRPC server. Null
  /// if the address cannot be had.
  static std::unique_ptr<Gateway> Open(const std::string& address,
                                       const std::shared_ptr<grpc::Channel>& channel,
                                       GatewayOptions options);

  /// Cuts all connections and waits until their calls have ended.
  ~Gateway();
  Gateway(const Gateway&) = delete;
  Gateway& operator=(const Gateway&) = delete;

  /// The port that it listens on; 0 for a socket file.
  int port() const;
  /// Numbers of connections that are open, and of those refused since the start.
  std::size_t connections() const;
  std::int64_t refused_connections() const;

  /// Accepts no more connections.
  void Close();

 private:
  class Threads;
  Gateway(Listener listener, const std::shared_ptr<grpc::Channel>& channel, GatewayOptions options);

  const int port_;
  /// Serve the connections.
  std::unique_ptr<Threads> threads_;
  std::unique_ptr<ConnectionAcceptor> acceptor_;  // Hands connections to threads_.
};

}  // namespace contact
