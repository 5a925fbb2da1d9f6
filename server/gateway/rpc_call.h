#pragma once

#include <grpcpp/grpcpp.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "gateway/protocol/rpc_request.h"
#include "gateway/service.h"

namespace contact::gateway {

/// Runs a function on the thread of a call's user, also after that one has left.
using Post = std::function<void(std::function<void()>)>;

/// Writes deadline, metadata and message of the call of `peer` where gRPC takes them from.
void Prepare(const RpcRequest& request, const std::string& peer, grpc::ClientContext* context,
             grpc::ByteBuffer* message);

/// A stream on its way through the server. One message at a time is read, and only when it is asked
/// for, so that a client that takes nothing holds up the stream and not the memory. Used on one
/// thread, but for what gRPC calls.
class RpcCall final : public grpc::ClientBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer> {
 public:
  /// Starts the call of `peer`, and asks for its first message. After each change of what is below,
  /// `changed` is called on the thread, until Leave. `post` lives as long as the call.
  static std::shared_ptr<RpcCall> Start(Service& service, const RpcRequest& request,
                                        const std::string& peer, Post post,
                                        std::function<void()> changed);

  /// Asks for the next message, unless one is asked for. To be followed by TakeMessage at once: the
  /// one before may still be there.
  void Read();
  /// Takes the message that was asked for, once it is there.
  std::optional<grpc::ByteBuffer> TakeMessage();

  /// True once the metadata before the messages are there, or the call has ended.
  bool has_head() const { return head_ || status_; }
  /// How the call has ended; nothing before. No message comes after that.
  const std::optional<grpc::Status>& status() const { return status_; }
  /// Metadata before the messages, once they are there; and after them, once the call has ended.
  const Trailers& head() const;
  const Trailers& trailers() const { return context_.GetServerTrailingMetadata(); }

  /// Cancels the call; it ends soon.
  void Cancel() { context_.TryCancel(); }
  /// The user has gone: nothing is called any more, and the call is cancelled if it has not ended.
  void Leave();

 private:
  RpcCall(Post post, std::function<void()> changed)
      : post_(std::move(post)), changed_(std::move(changed)) {}
  void OnReadInitialMetadataDone(bool ok) override;
  void OnReadDone(bool ok) override;
  void OnDone(const grpc::Status& status) override;
  /// Lets gRPC end the call, now that nothing is read any more.
  void Release();
  void Changed() const {
    if (changed_) changed_();
  }

  const Post post_;
  grpc::ClientContext context_;
  grpc::ByteBuffer request_;
  /// Filled by gRPC while a message is read.
  grpc::ByteBuffer incoming_;
  /// Keeps this until gRPC is done.
  std::shared_ptr<RpcCall> self_;

  // Of the user's thread.
  std::function<void()> changed_;
  bool head_ = false;
  bool reading_ = false;
  bool released_ = false;
  std::optional<grpc::ByteBuffer> message_;
  std::optional<grpc::Status> status_;
};

}  // namespace contact::gateway
