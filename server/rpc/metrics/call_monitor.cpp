#include "rpc/metrics/call_monitor.h"

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <string>

namespace contact {
namespace {

using grpc::experimental::InterceptionHookPoints;
using grpc::experimental::InterceptorBatchMethods;
using grpc::experimental::ServerRpcInfo;
using std::chrono::steady_clock;

// Interceptor of one call; lives as long as the call.
class Call final : public grpc::experimental::Interceptor {
 public:
  Call(ServerRpcInfo& info, std::shared_ptr<RpcMetrics> metrics, PeerCounts::Lease stream,
       std::shared_ptr<FloodGuard> floods)
      : info_(info),
        uri_(CallerUri(*info.server_context())),
        method_(info.method()),
        metrics_(std::move(metrics)),
        ours_(method_.starts_with("/contact.")),
        stream_(std::move(stream)),
        floods_(std::move(floods)),
        open_(floods_->Enter(uri_)) {
    metrics_->Began(method_);
  }
  ~Call() override {
    if (!ours_ && code_ == grpc::StatusCode::CANCELLED) TakenBack();
    if (code_ != grpc::StatusCode::CANCELLED) floods_->Answered(uri_);
    const std::chrono::duration<double> time = steady_clock::now() - begin_;
    metrics_->Ended(method_, code_, time.count());
  }

  void Intercept(InterceptorBatchMethods* methods) override {
    if (stream_ && methods->QueryInterceptionHookPoint(InterceptionHookPoints::PRE_SEND_MESSAGE)) {
      const auto* message = methods->GetSerializedSendMessage();
      metrics_->Streamed(method_, static_cast<std::int64_t>(message->Length()));
    }
    if (methods->QueryInterceptionHookPoint(InterceptionHookPoints::PRE_SEND_STATUS)) {
      code_ = methods->GetSendStatus().error_code();
    }
    if (ours_ && methods->QueryInterceptionHookPoint(InterceptionHookPoints::POST_RECV_CLOSE) &&
        info_.server_context()->IsCancelled()) {
      TakenBack();
    }
    methods->Proceed();
  }

 private:
  void TakenBack() { floods_->TakenBack(uri_, steady_clock::now()); }

  ServerRpcInfo& info_;    // gRPC's, which owns this.
  const std::string uri_;  // Of the connection.
  const std::string method_;
  const std::shared_ptr<RpcMetrics> metrics_;
  // gRPC's own services are synchronous: for them IsCancelled would come back here without end.
  const bool ours_;
  const PeerCounts::Lease stream_;  // Null for a call that is no stream.
  const std::shared_ptr<FloodGuard> floods_;
  const FloodGuard::Lease open_;
  const steady_clock::time_point begin_ = steady_clock::now();
  int code_ = grpc::StatusCode::CANCELLED;  // For calls that end without a status.
};

}  // namespace

grpc::experimental::Interceptor* CallMonitor::CreateServerInterceptor(ServerRpcInfo* info) {
  const bool stream = info->type() == ServerRpcInfo::Type::SERVER_STREAMING;
  return new Call(*info, metrics_,
                  stream ? streams_->Enter(PeerOf(CallerUri(*info->server_context()))) : nullptr,
                  floods_);
}

}  // namespace contact
