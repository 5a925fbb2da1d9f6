#pragma once

#include <grpcpp/support/server_interceptor.h>

#include <memory>
#include <utility>

#include "rpc/metrics/rpc_metrics.h"
#include "rpc/net/peer.h"

namespace contact {

/// Sees every call of the server from its begin to its end. Thread-safe.
class CallMonitor final : public grpc::experimental::ServerInterceptorFactoryInterface {
 public:
  /// Counts calls in `metrics`, and streams in `streams` while they are open.
  CallMonitor(std::shared_ptr<RpcMetrics> metrics, std::shared_ptr<PeerCounts> streams)
      : metrics_(std::move(metrics)), streams_(std::move(streams)) {}

  grpc::experimental::Interceptor* CreateServerInterceptor(
      grpc::experimental::ServerRpcInfo* info) override;

 private:
  const std::shared_ptr<RpcMetrics> metrics_;
  const std::shared_ptr<PeerCounts> streams_;
};

}  // namespace contact
