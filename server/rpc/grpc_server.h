#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <cstddef>
#include <memory>

#include "base/clock.h"
#include "jobs/job_manager.h"
#include "rpc/admin_service.h"
#include "rpc/call/call_guard.h"
#include "rpc/call_starter.h"
#include "rpc/job_service.h"
#include "rpc/model_service.h"
#include "rpc/stream/stream_loop.h"

namespace contact {

/// Settings of the gRPC server.
struct GrpcServerOptions {
  /// Largest size of a request.
  int max_message_bytes = 8 << 20;
  /// See CallGuard.
  CallLimits calls = {};
  /// A reader of a stream that takes nothing for this time is dropped.
  std::chrono::milliseconds write_stall{30'000};
  /// True: the server answers which services and messages there are.
  bool reflection = true;
  /// True: the server answers which calls there are and were.
  bool channelz = false;
  /// Who comes in.
  Door door = Door();
  /// True: the server has AdminService.
  bool admin = true;
  /// Where calls are counted.
  std::shared_ptr<RpcMetrics> metrics = std::make_shared<RpcMetrics>();
  /// Where changes and refused calls are written; null: nowhere.
  std::shared_ptr<AuditLog> audit = {};
};

/// The gRPC server of those who come in by one Door: its settings, its services, its end. It
/// listens on nothing: gRPC 1.51 bounds neither the frames nor the memory of a connection, so the
/// gateway takes all bytes from outside and hands over whole calls.
class GrpcServer {
 public:
  /// `identity`: see JobService. The manager, its store and the clock outlive the server.
  GrpcServer(JobManager& jobs, Store& store, const GrpcServerOptions& options,
             v1::ServerInfo identity, const Clock& clock = SystemClock());

  /// Shuts down if that has not been done.
  ~GrpcServer();

  GrpcServer(const GrpcServer&) = delete;
  GrpcServer& operator=(const GrpcServer&) = delete;

  /// Serves.
  void Start();

  /// A channel to the services. After Start only, and not to be used after Shutdown.
  std::shared_ptr<grpc::Channel> Inside() const;

  /// Health turns NOT_SERVING; streams, also those that begin later, end with SERVER_DRAINING.
  void Drain();

  /// Drains, gives open calls `grace` to end and cancels the rest. If gRPC does not shut down
  /// within 2 s more, the process ends with code 1, so that its supervisor can start it again.
  void Shutdown(std::chrono::milliseconds grace);

  /// Number of streams that are open.
  std::size_t watchers() const { return loop_->streams(); }

  /// Counters of calls and of streams.
  std::shared_ptr<const RpcMetrics> metrics() const { return metrics_; }
  std::shared_ptr<const StreamMetrics> stream_metrics() const { return loop_->metrics(); }

 private:
  const GrpcServerOptions options_;
  const std::shared_ptr<StreamLoop> loop_;
  /// Open streams of each peer.
  const std::shared_ptr<PeerCounts> streams_ = std::make_shared<PeerCounts>();
  const std::shared_ptr<RpcMetrics> metrics_;
  CallGuard guard_;
  /// Starts the calls of all services.
  CallStarter calls_;
  /// The services. gRPC uses them until server_ is gone.
  JobService jobs_;
  ModelService models_;
  AdminService admin_;
  /// Null before Start and after Shutdown.
  std::unique_ptr<grpc::Server> server_;
};

}  // namespace contact
