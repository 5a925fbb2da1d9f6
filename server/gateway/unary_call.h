#pragma once

#include <grpcpp/grpcpp.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "gateway/rpc_call.h"

namespace contact::gateway {

/// A call with one answer on its way through the server. It is one operation of gRPC, so that its
/// user is woken once. Used on one thread.
class UnaryCall final {
 public:
  /// Starts the call of `peer`. The service outlives it. When it has ended, `ended` is called on
  /// the thread, unless its user has left. `post` lives as long as the call, and is destroyed on
  /// the thread.
  static std::shared_ptr<UnaryCall> Start(Service& service, const RpcRequest& request,
                                          const std::string& peer, Post post,
                                          std::function<void()> ended);

  /// How the call has ended; nothing before. INTERNAL also if it gave no answer,
  /// RESOURCE_EXHAUSTED if there is no memory for the answer.
  const std::optional<grpc::Status>& status() const { return status_; }
  // Once it has ended:
  /// Takes the bytes of the answer; none if the status is not OK.
  std::string TakeAnswer();
  /// Metadata before the answer, and after it.
  const Trailers& head() const { return context_.GetServerInitialMetadata(); }
  const Trailers& trailers() const { return context_.GetServerTrailingMetadata(); }

  /// Cancels the call; it ends soon.
  void Cancel() { context_.TryCancel(); }
  /// The user has gone: nothing is called any more, and the call is cancelled if it has not ended.
  void Leave();

 private:
  UnaryCall(Memory& answers, Post post, std::function<void()> ended)
      : answers_(answers), post_(std::move(post)), ended_(std::move(ended)) {}
  /// Called by gRPC: goes on at End.
  void OnDone(const grpc::Status& status);
  void End(const grpc::Status& status);

  Memory& answers_;
  const Post post_;
  /// Keeps this until gRPC is done.
  std::shared_ptr<UnaryCall> self_;
  grpc::ClientContext context_;
  grpc::ByteBuffer request_;
  grpc::ByteBuffer answer_;
  /// What the answer has of answers_.
  Memory::Share room_;

  // Of the user's thread.
  std::function<void()> ended_;
  std::optional<grpc::Status> status_;
};

}  // namespace contact::gateway
