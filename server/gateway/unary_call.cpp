#include "gateway/unary_call.h"

#include <utility>

namespace contact::gateway {

std::shared_ptr<UnaryCall> UnaryCall::Start(grpc::GenericStub& stub, const RpcRequest& request,
                                            const std::string& peer, Post post,
                                            std::function<void()> ended) {
  std::shared_ptr<UnaryCall> call(new UnaryCall(std::move(post), std::move(ended)));
  call->self_ = call;
  Prepare(request, peer, &call->context_, &call->request_);
  stub.UnaryCall(&call->context_, request.path, grpc::StubOptions(), &call->request_,
                 &call->answer_, [call = call.get()](const grpc::Status& s) { call->OnDone(s); });
  return call;
}

// Nothing of the call stays with gRPC's thread: the guard in post_, released there, could stop an
// io_context that its own thread destroys at that moment.
void UnaryCall::OnDone(const grpc::Status& status) {
  post_([self = std::move(self_), status] { self->End(status); });
}

void UnaryCall::Leave() {
  ended_ = nullptr;
  if (!status_) context_.TryCancel();
}

void UnaryCall::End(const grpc::Status& status) {
  status_ = status;
  if (status.ok() && !answer_.Valid()) {
    status_ = {grpc::StatusCode::INTERNAL, "the call gave no answer"};
  }
  if (ended_) ended_();
}

}  // namespace contact::gateway
