#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "base/clock.h"
#include "base/executor.h"
#include "jobs/job_manager.h"
#include "rpc/admin_service.h"
#include "rpc/call/call_guard.h"
#include "rpc/call_starter.h"
#include "rpc/job_service.h"
#include "rpc/net/connection_acceptor.h"
#include "rpc/net/flood_guard.h"
#include "rpc/stream/stream_loop.h"

namespace contact {

/// Settings of the gRPC server.
struct GrpcServerOptions {
  /// Largest size of a request.
  int max_message_bytes = 8 << 20;
  /// Memory of all connections and messages. Past it gRPC cuts some connections.
  int max_memory_bytes = 512 << 20;
  /// See ConnectionAcceptor.
  ConnectionLimits connections = {};
  /// See CallGuard.
  CallLimits calls = {};
  /// A connection that has not begun to speak HTTP/2 after this time is closed.
  std::chrono::milliseconds handshake_timeout{5'000};
  /// A reader of a stream that takes nothing for this time is dropped; also the limit of
  /// `connections.stall`, which it replaces.
  std::chrono::milliseconds write_stall{30'000};
  /// True: the server answers which services and messages there are.
  bool reflection = true;
  /// True: the server answers which connections there are, and what went over them.
  bool channelz = false;
  /// Who comes in.
  Door door = Door();
  /// How connections are protected; null: not at all.
  std::shared_ptr<grpc::ServerCredentials> credentials = {};
  /// True: the server has AdminService.
  bool admin = true;
  /// Where calls are counted.
  std::shared_ptr<RpcMetrics> metrics = std::make_shared<RpcMetrics>();
  /// Where changes and refused calls are written; null: nowhere.
  std::shared_ptr<AuditLog> audit = {};
};

/// The gRPC server of one listener: its settings, its services, its end.
class GrpcServer {
 public:
  /// `identity`: see JobService. The manager, its store and the clock outlive the server.
  GrpcServer(JobManager& jobs, Store& store, const GrpcServerOptions& options,
             v1::ServerInfo identity, const Clock& clock = SystemClock());

  /// Shuts down if that has not been done.
  ~GrpcServer();

  GrpcServer(const GrpcServer&) = delete;
  GrpcServer& operator=(const GrpcServer&) = delete;

  /// Listens on `HOST:PORT`, port 0 being any free one, and serves. Returns the port; nothing if
  /// the address cannot be had. Another server on the same port is such a case. `unix:PATH` is a
  /// socket file that its owner and group may use; its port is 0.
  std::optional<int> Start(const std::string& address);

  /// A channel to the services that passes neither listener nor acceptor. After Start only.
  std::shared_ptr<grpc::Channel> Inside() const { return server_->InProcessChannel({}); }

  /// Health turns NOT_SERVING; streams, also those that begin later, end with SERVER_DRAINING.
  void Drain();

  /// Drains, gives open calls `grace` to end and cancels the rest. If gRPC does not shut down
  /// within 2 s more, the process ends with code 1, so that its supervisor can start it again.
  void Shutdown(std::chrono::milliseconds grace);

  /// Number of streams that are open.
  std::size_t watchers() const { return loop_->streams(); }

  /// Numbers of connections that are open, and of those refused since the start.
  std::size_t connections() const { return acceptor_ ? acceptor_->open() : 0; }
  std::int64_t refused_connections() const { return acceptor_ ? acceptor_->refused() : 0; }

  /// Counters of calls and of streams.
  std::shared_ptr<const RpcMetrics> metrics() const { return metrics_; }
  std::shared_ptr<const StreamMetrics> stream_metrics() const { return loop_->metrics(); }

 private:
  /// Starts gRPC and the acceptor of the listener's connections. Returns the port.
  std::optional<int> Listen(Listener listener, grpc::ServerBuilder& builder);

  /// The options, with connections reduced to what descriptors suffice for.
  const GrpcServerOptions options_;
  const std::shared_ptr<StreamLoop> loop_;
  /// Open streams of each peer.
  const std::shared_ptr<PeerCounts> streams_ = std::make_shared<PeerCounts>();
  /// Cuts connections by acceptor_.
  const std::shared_ptr<FloodGuard> floods_ = std::make_shared<FloodGuard>();
  const std::shared_ptr<RpcMetrics> metrics_;
  CallGuard guard_;
  /// Starts the calls of both services.
  CallStarter calls_;
  /// The services. gRPC uses them until server_ is gone.
  JobService jobs_;
  AdminService admin_;
  /// Gives connections to gRPC, which reads a new one on the thread that does so, for as long as
  /// there is something to read.
  Executor hand_over_{"hand-over"};
  /// Null before Start and after Shutdown.
  std::unique_ptr<grpc::Server> server_;
  std::unique_ptr<ConnectionAcceptor> acceptor_;  // Hands connections to server_.
};

}  // namespace contact
