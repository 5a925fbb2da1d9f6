#pragma once

#include <grpcpp/support/server_interceptor.h>

#include <memory>
#include <utility>

#include "rpc/metrics/rpc_metrics.h"
#include "rpc/net/peer.h"

namespace contact {

/// Makes gRPC's interceptor of each call, which counts the call from its start to its end.
/// Thread-safe.
class CallMonitor final : public grpc::experimental::ServerInterceptorFactoryInterface {
 public:
  /// Calls are counted in `metrics`, streams in `streams` while they are open.
  CallMonitor(std::shared_ptr<RpcMetrics> metrics, std::shared_ptr<PeerCounts> streams)
      : metrics_(std::move(metrics)), streams_(std::move(streams)) {}

  /// The interceptor of one call. gRPC owns and deletes it.
  grpc::experimental::Interceptor* CreateServerInterceptor(
      grpc::experimental::ServerRpcInfo* info) override;

 private:
  const std::shared_ptr<RpcMetrics> metrics_;
  /// Open streams of each peer.
  const std::shared_ptr<PeerCounts> streams_;
};

}  // namespace contact
