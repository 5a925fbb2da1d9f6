#include "gateway/unary_call.h"

#include <utility>

#include "gateway/outgoing.h"

namespace contact::gateway {

std::shared_ptr<UnaryCall> UnaryCall::Start(Service& service, const RpcRequest& request,
                                            const std::string& peer, Post post,
                                            std::function<void()> ended) {
  std::shared_ptr<UnaryCall> call(
      new UnaryCall(service.answers(), std::move(post), std::move(ended)));
  call->self_ = call;
  Prepare(request, peer, &call->context_, &call->request_);
  service.stub().UnaryCall(&call->context_, request.path, grpc::StubOptions(), &call->request_,
                           &call->answer_,
                           [call = call.get()](const grpc::Status& s) { call->OnDone(s); });
  return call;
}

// Nothing of the call stays with gRPC's thread: the guard in post_, released there, could stop an
// io_context that its own thread destroys at that moment.
void UnaryCall::OnDone(const grpc::Status& status) {
  room_ = answers_.Take(answer_.Length());
  if (!room_) answer_.Clear();  // At once: answers may wait long for their thread.
  post_([self = std::move(self_), status] { self->End(status); });
}

std::string UnaryCall::TakeAnswer() {
  std::string bytes = Flat(answer_);
  answer_.Clear();
  room_.reset();
  return bytes;
}

void UnaryCall::Leave() {
  ended_ = nullptr;
  if (!status_) context_.TryCancel();
}

void UnaryCall::End(const grpc::Status& status) {
  status_ = status;
  if (!room_) {
    status_ = {grpc::StatusCode::RESOURCE_EXHAUSTED, kNoRoom};
  } else if (status.ok() && !answer_.Valid()) {
    status_ = {grpc::StatusCode::INTERNAL, "the call gave no answer"};
  }
  if (ended_) ended_();
}

}  // namespace contact::gateway
