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
  Call(const ServerRpcInfo& info, std::shared_ptr<RpcMetrics> metrics, PeerCounts::Lease stream)
      : method_(info.method()), metrics_(std::move(metrics)), stream_(std::move(stream)) {
    metrics_->Began(method_);
  }
  ~Call() override {
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
    methods->Proceed();
  }

 private:
  const std::string method_;
  const std::shared_ptr<RpcMetrics> metrics_;
  const PeerCounts::Lease stream_;  // Null for a call that is no stream.
  const steady_clock::time_point begin_ = steady_clock::now();
  int code_ = grpc::StatusCode::CANCELLED;  // For calls that end without a status.
};

}  // namespace

grpc::experimental::Interceptor* CallMonitor::CreateServerInterceptor(ServerRpcInfo* info) {
  const bool stream = info->type() == ServerRpcInfo::Type::SERVER_STREAMING;
  return new Call(*info, metrics_,
                  stream ? streams_->Enter(PeerOf(CallerUri(*info->server_context()))) : nullptr);
}

}  // namespace contact
