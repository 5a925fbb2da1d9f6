#include "gateway/call/unary_call.h"

#include <boost/asio/post.hpp>
#include <utility>

#include "gateway/call/outgoing.h"

namespace contact::gateway {

std::shared_ptr<UnaryCall> UnaryCall::Start(Service& service, const HttpRequest& head,
                                            const RpcRequest& request,
                                            std::shared_ptr<Exchange> exchange) {
  std::shared_ptr<UnaryCall> call(new UnaryCall(service.answers(), std::move(exchange)));
  call->self_ = call;
  Prepare(service, head, request, call->exchange_->peer(), &call->context_);
  const grpc::Slice slice(request.message);
  call->request_ = grpc::ByteBuffer(&slice, 1);
  service.stub().UnaryCall(&call->context_, request.path, grpc::StubOptions(), &call->request_,
                           &call->answer_,
                           [call = call.get()](const grpc::Status& s) { call->OnDone(s); });
  return call;
}

// Nothing of the call stays with gRPC's thread, see RpcCall::OnDone.
void UnaryCall::OnDone(const grpc::Status& status) {
  room_ = answers_.Take(answer_.Length());
  if (!room_) answer_.Clear();  // At once: answers may wait long for their thread.
  const Executor executor = work_.get_executor();
  boost::asio::post(executor, [self = std::move(self_), status] { self->End(status); });
}

std::string UnaryCall::TakeAnswer() {
  std::string bytes = Flat(answer_);
  answer_.Clear();
  room_.reset();
  return bytes;
}

void UnaryCall::End(const grpc::Status& status) {
  status_ = status;
  if (!room_) {
    status_ = {grpc::StatusCode::RESOURCE_EXHAUSTED, kNoRoom};
  } else if (status.ok() && !answer_.Valid()) {
    status_ = {grpc::StatusCode::INTERNAL, "the call gave no answer"};
  }
  exchange_->Wake();
}

}  // namespace contact::gateway
