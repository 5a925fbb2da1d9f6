#pragma once

#include <grpcpp/grpcpp.h>

#include <memory>
#include <optional>
#include <string>

#include "gateway/call/rpc_call.h"

namespace contact::gateway {

/// A call with one answer on its way through the server. It is one operation of gRPC, so that its
/// user is woken once. Used on the thread of its exchange; its user waits for `status` before it
/// lets go.
class UnaryCall final {
 public:
  /// Starts the call with the request's message. When it has ended, the exchange wakes.
  static std::shared_ptr<UnaryCall> Start(Service& service, const HttpRequest& head,
                                          const RpcRequest& request,
                                          std::shared_ptr<Exchange> exchange);

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

 private:
  UnaryCall(Memory& answers, std::shared_ptr<Exchange> exchange)
      : answers_(answers), work_(exchange->io().get_executor()), exchange_(std::move(exchange)) {}
  /// Called by gRPC: goes on at End.
  void OnDone(const grpc::Status& status);
  void End(const grpc::Status& status);

  Memory& answers_;
  const Work work_;
  const std::shared_ptr<Exchange> exchange_;
  /// Keeps this until gRPC is done.
  std::shared_ptr<UnaryCall> self_;
  grpc::ClientContext context_;
  grpc::ByteBuffer request_;
  grpc::ByteBuffer answer_;
  /// What the answer has of answers_.
  Memory::Share room_;
  std::optional<grpc::Status> status_;  // Of the exchange's thread.
};

}  // namespace contact::gateway
