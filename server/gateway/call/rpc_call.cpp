#include "gateway/call/rpc_call.h"

#include <boost/asio/post.hpp>
#include <utility>

#include "identity/door.h"
#include "rpc/net/peer.h"

namespace contact::gateway {
namespace {

// Small messages wake the user some at a time; a stalled stream holds so much, or one message
// (fault/drain).
constexpr std::size_t kReadAhead = 4 << 10;

}  // namespace

void Prepare(const Service& service, const HttpRequest& head, const RpcRequest& request,
             const Peer& peer, grpc::ClientContext* context) {
  if (request.timeout) {
    context->set_deadline(std::chrono::system_clock::now() + *request.timeout);
  }
  for (const auto& [name, value] : request.metadata) context->AddMetadata(name, value);
  context->AddMetadata(kPeerHeader, peer.uri);
  for (const std::string& name : peer.names) context->AddMetadata(kCertificateHeader, name);
  if (!service.options().trusts_principal) return;
  for (const auto& [name, value] : head.headers) {
    if (name == kPrincipalHeader) context->AddMetadata(name, value);
  }
}

std::shared_ptr<RpcCall> RpcCall::Start(Service& service, const HttpRequest& head,
                                        const RpcRequest& request,
                                        std::shared_ptr<Exchange> exchange) {
  std::shared_ptr<RpcCall> call(new RpcCall(std::move(exchange)));
  call->self_ = call;
  Prepare(service, head, request, call->exchange_->peer(), &call->context_);
  service.stub().PrepareBidiStreamingCall(&call->context_, request.path, grpc::StubOptions(),
                                          call.get());
  call->AddHold();  // Reads and writes start outside of gRPC's reactions.
  {
    const MutexLock lock(call->mutex_);
    call->reading_ = true;
  }
  // Before the call: the in-process transport of gRPC 1.51 drops a message that comes together with
  // the status while nobody reads.
  call->StartRead(&call->incoming_);
  call->StartCall();
  return call;
}

void RpcCall::Write(const grpc::ByteBuffer& message) {
  request_ = message;
  writing_ = true;
  StartWrite(&request_);
}

void RpcCall::EndWrites() {
  wrote_all_ = true;
  StartWritesDone();
}

const Trailers& RpcCall::head() const {
  static const Trailers none;
  return head_ ? context_.GetServerInitialMetadata() : none;
}

std::vector<grpc::ByteBuffer> RpcCall::Take(bool ahead) {
  std::vector<grpc::ByteBuffer> taken;
  bool read = false;
  {
    const MutexLock lock(mutex_);
    taken.swap(messages_);
    ahead_ = 0;
    read = (ahead || taken.empty()) && !reading_ && !read_all_ && !released_;
    reading_ = reading_ || read;
  }
  if (read) StartRead(&incoming_);
  return taken;
}

void RpcCall::Cancel() {
  bool idle = false;
  {
    const MutexLock lock(mutex_);
    if (std::exchange(cancelled_, true)) return;
    idle = !reading_;
  }
  context_.TryCancel();
  if (idle) Release();
}

void RpcCall::Release() {
  if (std::exchange(released_, true)) return;
  RemoveHold();
}

void RpcCall::OnReadInitialMetadataDone(bool ok) {
  const MutexLock lock(mutex_);
  has_metadata_ = ok;
  if (ok) Tell();
}

void RpcCall::OnReadDone(bool ok) {
  bool more = false;
  {
    const MutexLock lock(mutex_);
    read_all_ = !ok || cancelled_;
    if (!read_all_) {
      ahead_ += incoming_.Length();
      messages_.push_back(std::move(incoming_));
      incoming_.Clear();
      more = ahead_ < kReadAhead;
    }
    reading_ = more;
    Tell();
  }
  if (more) StartRead(&incoming_);
}

void RpcCall::OnWriteDone(bool /*ok*/) {
  const MutexLock lock(mutex_);
  wrote_ = true;
  Tell();
}

// Nothing of the call stays with gRPC's thread: the guard in work_, released there, could stop an
// io_context that its own thread destroys at that moment.
void RpcCall::OnDone(const grpc::Status& status) {
  const Executor executor = work_.get_executor();
  boost::asio::post(executor, [self = std::move(self_), status] {
    self->status_ = status;
    self->exchange_->Wake();
  });
}

void RpcCall::Tell() {
  if (std::exchange(told_, true)) return;
  boost::asio::post(work_.get_executor(), [self = self_] { self->Look(); });
}

void RpcCall::Look() {
  bool release = false;
  {
    const MutexLock lock(mutex_);
    told_ = false;
    if (std::exchange(wrote_, false)) writing_ = false;
    head_ = has_metadata_;
    release = read_all_;
  }
  if (release) Release();
  exchange_->Wake();
}

}  // namespace contact::gateway
