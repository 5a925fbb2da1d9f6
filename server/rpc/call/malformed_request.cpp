#include "rpc/call/malformed_request.h"

#include "rpc/call/status.h"

namespace contact {
namespace {

using grpc::experimental::InterceptionHookPoints;

// No handler of ours gives this code.
bool IsOfGrpc(const grpc::Status& status) {
  return status.error_code() == grpc::StatusCode::UNIMPLEMENTED && status.error_message().empty();
}

class Interceptor final : public grpc::experimental::Interceptor {
 public:
  void Intercept(grpc::experimental::InterceptorBatchMethods* methods) override {
    if (methods->QueryInterceptionHookPoint(InterceptionHookPoints::PRE_SEND_STATUS) &&
        IsOfGrpc(methods->GetSendStatus())) {
      methods->ModifySendStatus(
          ToGrpc(MakeError(Reason::kFieldInvalid, "the request is no message of its type")));
    }
    methods->Proceed();
  }
};

}  // namespace

grpc::experimental::Interceptor* MalformedRequests::CreateServerInterceptor(
    grpc::experimental::ServerRpcInfo* info) {
  // To gRPC a method that there is not is such a stream; the contract has none.
  const bool known = info->type() != grpc::experimental::ServerRpcInfo::Type::BIDI_STREAMING;
  return known ? new Interceptor() : nullptr;
}

}  // namespace contact
