#include "gateway/rpc_call.h"

#include <utility>

#include "rpc/net/peer.h"

namespace contact::gateway {

void Prepare(const RpcRequest& request, const std::string& peer, grpc::ClientContext* context,
             grpc::ByteBuffer* message) {
  if (request.timeout) {
    context->set_deadline(std::chrono::system_clock::now() + *request.timeout);
  }
  for (const auto& [name, value] : request.metadata) context->AddMetadata(name, value);
  context->AddMetadata(kPeerHeader, peer);
  const grpc::Slice slice(request.message);
  *message = grpc::ByteBuffer(&slice, 1);
}

std::shared_ptr<RpcCall> RpcCall::Start(Service& service, const RpcRequest& request,
                                        const std::string& peer, Post post,
                                        std::function<void()> changed) {
  std::shared_ptr<RpcCall> call(new RpcCall(std::move(post), std::move(changed)));
  call->self_ = call;
  Prepare(request, peer, &call->context_, &call->request_);
  service.stub().PrepareBidiStreamingCall(&call->context_, request.path, grpc::StubOptions(),
                                          call.get());
  call->AddHold();  // Reads start outside of gRPC's reactions.
  call->StartWriteLast(&call->request_, grpc::WriteOptions());
  // Before the call: the in-process transport of gRPC 1.51 drops a message that comes together with
  // the status while nobody reads.
  call->Read();
  call->StartCall();
  return call;
}

const Trailers& RpcCall::head() const {
  static const Trailers none;
  return head_ ? context_.GetServerInitialMetadata() : none;
}

void RpcCall::Read() {
  if (released_ || reading_) return;
  reading_ = true;
  incoming_.Clear();
  StartRead(&incoming_);
}

std::optional<grpc::ByteBuffer> RpcCall::TakeMessage() {
  return std::exchange(message_, std::nullopt);
}

void RpcCall::Leave() {
  changed_ = nullptr;
  if (!status_) context_.TryCancel();
  if (!reading_) Release();
}

void RpcCall::Release() {
  if (std::exchange(released_, true)) return;
  RemoveHold();
}

void RpcCall::OnReadInitialMetadataDone(bool ok) {
  if (!ok) return;
  post_([self = self_] {
    self->head_ = true;
    self->Changed();
  });
}

void RpcCall::OnReadDone(bool ok) {
  post_([self = self_, ok] {
    self->reading_ = false;
    if (ok) self->message_ = std::move(self->incoming_);
    if (!ok || !self->changed_) self->Release();
    self->Changed();
  });
}

void RpcCall::OnDone(const grpc::Status& status) {
  post_([self = std::move(self_), status] {
    self->status_ = status;
    self->Changed();
  });
}

}  // namespace contact::gateway
