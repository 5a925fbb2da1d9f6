#pragma once

#include <grpcpp/channel.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "gateway/call/options.h"
#include "gateway/net/held_bytes.h"
#include "rpc/net/listener.h"

namespace contact {

namespace gateway {
class Acceptor;
class Service;
}  // namespace gateway

/// The threads on which gateways serve their connections, and what the connections of all of them
/// may hold. Each connection stays on one thread: threads that share an io_context wake each other
/// at each step of a call.
class GatewayThreads {
 public:
  /// `most_bytes`: see HeldBytes.
  explicit GatewayThreads(std::size_t most_bytes = 256 << 20);
  /// Waits until gRPC is done with all calls. No gateway uses them any more.
  ~GatewayThreads();
  GatewayThreads(const GatewayThreads&) = delete;
  GatewayThreads& operator=(const GatewayThreads&) = delete;

 private:
  friend class Gateway;
  class Pool;
  gateway::HeldBytes held_;
  const std::unique_ptr<Pool> pool_;
};

/// The one door of the server: takes every byte from outside that comes to a listener, over TLS or
/// not, and counts it before anything trusts it. HTTP/2 and HTTP/1.1 bring calls in the protocols
/// gRPC, gRPC-Web and Connect, the pages `/metrics`, `/healthz` and `/readyz`, and the dashboard.
/// Calls enter the gRPC server within the process, and are told the client's address and the names
/// in its certificate.
class Gateway {
 public:
  /// Serves those who come to the listener. `channel` leads into the gRPC server. The threads
  /// outlive the gateway.
  Gateway(GatewayThreads& threads, Listener listener, const std::shared_ptr<grpc::Channel>& channel,
          GatewayOptions options);

  /// Cuts all connections and waits until their calls have ended.
  ~Gateway();
  Gateway(const Gateway&) = delete;
  Gateway& operator=(const Gateway&) = delete;

  /// Numbers of connections that are open, and of those refused since the start.
  std::size_t connections() const;
  std::int64_t refused_connections() const;

  /// Accepts no more connections, and refuses requests with SERVER_DRAINING. Idempotent.
  void Drain();
  /// Drains, and waits until the requests that came before are answered, for at most `grace`. The
  /// gRPC server outlives the gateway.
  void Finish(std::chrono::milliseconds grace);

 private:
  const std::shared_ptr<gateway::Service> service_;
  /// Null once it is closed.
  std::shared_ptr<gateway::Acceptor> acceptor_;
};

}  // namespace contact
