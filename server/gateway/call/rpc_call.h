#pragma once

#include <grpcpp/grpcpp.h>

#include <boost/asio/executor_work_guard.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "base/mutex.h"
#include "gateway/call/exchange.h"
#include "gateway/call/service.h"
#include "gateway/protocol/rpc_request.h"

namespace contact::gateway {

/// Keeps the thread of an exchange until gRPC is done with a call.
using Work = boost::asio::executor_work_guard<Executor>;

/// Writes deadline and metadata where gRPC takes them from.
void Prepare(const Service& service, const HttpRequest& head, const RpcRequest& request,
             const Peer& peer, grpc::ClientContext* context);

/// A stream of messages through the server, in both directions. Up to 4 KiB of the server's
/// messages are read ahead, so that small ones do not wake the user one by one, and no more, so
/// that a client that takes nothing holds up the stream and not the memory. Used on the thread of
/// its exchange; its user waits for `status` before it lets go.
class RpcCall final : public grpc::ClientBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>,
                      public std::enable_shared_from_this<RpcCall> {
 public:
  /// Starts the call. After each change of what is below the exchange wakes.
  static std::shared_ptr<RpcCall> Start(Service& service, const HttpRequest& head,
                                        const RpcRequest& request,
                                        std::shared_ptr<Exchange> exchange);

  /// True if the next message can be written.
  bool writable() const { return !writing_ && !wrote_all_ && !released_; }
  /// Writes a message. Only if writable.
  void Write(const grpc::ByteBuffer& message);
  /// No more messages are written. Only if writable.
  void EndWrites();

  /// Takes the messages that have come, in their order. If there are none, or with `ahead`, more
  /// are asked for.
  std::vector<grpc::ByteBuffer> Take(bool ahead);

  /// True once the metadata before the messages are there, or the call has ended.
  bool has_head() const { return head_ || status_; }
  /// How the call has ended, once all its messages are taken; nothing before.
  const std::optional<grpc::Status>& status() const { return status_; }
  /// Metadata before the messages, once they are there; and after them, once the call has ended.
  const Trailers& head() const;
  const Trailers& trailers() const { return context_.GetServerTrailingMetadata(); }

  /// Cancels the call; it ends soon, and what has come is lost.
  void Cancel();

 private:
  explicit RpcCall(std::shared_ptr<Exchange> exchange)
      : work_(exchange->io().get_executor()), exchange_(std::move(exchange)) {}
  void OnReadInitialMetadataDone(bool ok) override;
  void OnReadDone(bool ok) override;
  void OnWriteDone(bool ok) override;
  void OnDone(const grpc::Status& status) override;
  /// Has Look called on the exchange's thread, once for many changes.
  void Tell() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void Look();
  /// Lets gRPC end the call, now that neither is read nor written any more.
  void Release();

  const Work work_;
  const std::shared_ptr<Exchange> exchange_;
  grpc::ClientContext context_;
  grpc::ByteBuffer request_;
  /// Filled by gRPC while a message is read.
  grpc::ByteBuffer incoming_;
  /// Keeps this until gRPC is done.
  std::shared_ptr<RpcCall> self_;

  Mutex mutex_;
  std::vector<grpc::ByteBuffer> messages_ ABSL_GUARDED_BY(mutex_);
  /// Of messages_ [B].
  std::size_t ahead_ ABSL_GUARDED_BY(mutex_) = 0;
  bool reading_ ABSL_GUARDED_BY(mutex_) = false;
  /// Nothing more is read.
  bool read_all_ ABSL_GUARDED_BY(mutex_) = false;
  bool wrote_ ABSL_GUARDED_BY(mutex_) = false;
  bool has_metadata_ ABSL_GUARDED_BY(mutex_) = false;
  /// Look is about to be called.
  bool told_ ABSL_GUARDED_BY(mutex_) = false;
  bool cancelled_ ABSL_GUARDED_BY(mutex_) = false;

  // Of the exchange's thread.
  bool head_ = false;
  bool writing_ = false;
  bool wrote_all_ = false;
  bool released_ = false;
  std::optional<grpc::Status> status_;
};

}  // namespace contact::gateway
