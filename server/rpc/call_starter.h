#pragma once

#include <google/protobuf/message.h>
#include <grpcpp/grpcpp.h>

#include <memory>
#include <string>
#include <utility>

#include "rpc/call/call_guard.h"
#include "rpc/call/status.h"
#include "rpc/stream/stream_reactor.h"

namespace contact {

/// Starts the calls of every service: refuses those that are past a limit, and turns results into
/// responses and errors into statuses. Thread-safe.
class CallStarter {
 public:
  /// The guard outlives it.
  CallStarter(CallGuard& guard, std::shared_ptr<StreamLoop> loop)
      : guard_(guard), loop_(std::move(loop)) {}

  /// Starts a unary call. `run(answer)` is called unless the call is refused; `answer` takes a
  /// Result<T>, once, at once or later, on any thread. T is Response, or bool for an empty one, or
  /// a message for one of bytes.
  template <class T, class Response, class Run>
  grpc::ServerUnaryReactor* Unary(grpc::CallbackServerContext* context, Response* response, Run run,
                                  CallKind kind = CallKind::kUnary) {
    auto* reactor = context->DefaultReactor();
    const auto answer = [reactor, response](Result<T> result) {
      if (!result.ok()) return reactor->Finish(ToGrpc(result.error()));
      Put(std::move(result.value()), response);
      reactor->Finish(grpc::Status::OK);
    };
    if (const auto refusal = guard_.Check(*context, kind)) {
      answer(*refusal);
    } else {
      run(answer);
    }
    return reactor;
  }

  /// Starts a stream. `label` and `open`: see StreamReactor::Start.
  template <class Message, class Open>
  grpc::ServerWriteReactor<Message>* Stream(grpc::CallbackServerContext* context, std::string label,
                                            Open open) {
    if (const auto refusal = guard_.Check(*context, CallKind::kStream)) {
      return StreamReactor<Message>::Refuse(loop_, context, *refusal);
    }
    return StreamReactor<Message>::Start(loop_, context, std::move(label), std::move(open));
  }

  /// The loop of all streams.
  const StreamLoop& loop() const { return *loop_; }

 private:
  /// Moves a result into the response.
  static void Put(bool /*done*/, google::protobuf::Empty* /*response*/) {}
  static void Put(const google::protobuf::Message& value, grpc::ByteBuffer* response) {
    const grpc::Slice bytes(value.SerializeAsString());
    *response = grpc::ByteBuffer(&bytes, 1);
  }
  template <class T>
  static void Put(T value, T* response) {
    *response = std::move(value);
  }

  CallGuard& guard_;
  const std::shared_ptr<StreamLoop> loop_;
};

}  // namespace contact
