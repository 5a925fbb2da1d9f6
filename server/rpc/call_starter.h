#pragma once

#include <google/protobuf/empty.pb.h>
#include <google/protobuf/message.h>
#include <grpcpp/grpcpp.h>

#include <memory>
#include <string>
#include <utility>

#include "jobs/job/callback.h"
#include "rpc/call/audit.h"
#include "rpc/call/call_guard.h"
#include "rpc/call/status.h"
#include "rpc/stream/rightful_source.h"
#include "rpc/stream/stream_reactor.h"

namespace contact {

/// Starts the calls of every service: refuses those that the guard refuses, turns results into
/// responses and errors into statuses, and has both written to the audit log. Thread-safe.
class CallStarter {
 public:
  /// The guard outlives it. `log` may be null.
  CallStarter(CallGuard& guard, std::shared_ptr<StreamLoop> loop, std::shared_ptr<AuditLog> log)
      : guard_(guard), loop_(std::move(loop)), log_(std::move(log)) {}

  /// Starts a unary call. `run(caller, answer)` is called unless the call is refused; `answer`
  /// takes a Result<T>, once, at once or later, on any thread. T is Response, or bool for an empty
  /// one, or a message for one of bytes.
  template <class T, class Response, class Run>
  grpc::ServerUnaryReactor* Unary(grpc::CallbackServerContext* context, const Call& call,
                                  Response* response, Run run) {
    auto* reactor = context->DefaultReactor();
    Admission admission = guard_.Check(*context, call.method, call.kind);
    const Audit audit(log_, loop_->clock(), *context, call, admission);
    if (admission.refusal) {
      audit.End(Result<T>(*admission.refusal));
      reactor->Finish(ToGrpc(*admission.refusal));
      return reactor;
    }
    const auto held = std::make_shared<Quotas::Place>(std::move(admission.held));
    run(*admission.caller, [this, reactor, response, audit, held](Result<T> result) {
      audit.End(result);
      *held = nullptr;  // Before the client knows.
      if (!result.ok()) {
        guard_.NoteRefusal(result.error());
        return reactor->Finish(ToGrpc(result.error()));
      }
      Put(std::move(result.value()), response);
      reactor->Finish(grpc::Status::OK);
    });
    return reactor;
  }

  /// Starts a stream. `open(caller, wake, opened)` and `label`: see StreamReactor::Start.
  template <class Message, class Open>
  grpc::ServerWriteReactor<Message>* Stream(grpc::CallbackServerContext* context, const Call& call,
                                            std::string label, Open open) {
    Admission admission = guard_.Check(*context, call.method, call.kind);
    if (admission.refusal) return Refuse<Message>(context, call, admission);
    return StreamReactor<Message>::Start(
        loop_, context, std::move(label), std::move(admission.held), [&](auto wake, auto opened) {
          open(*admission.caller, wake,
               Rightful<Message>(opened, guard_.RightOf(*context, call.method, *admission.caller)));
        });
  }

  /// As Stream, for a call that may begin only once the audit log has it: else the call ends with
  /// AUDIT_FAILED. `open` is then called on the log's thread.
  template <class Message, class Open>
  grpc::ServerWriteReactor<Message>* AuditedStream(grpc::CallbackServerContext* context,
                                                   const Call& call, std::string label, Open open) {
    Admission admission = guard_.Check(*context, call.method, call.kind);
    if (admission.refusal) return Refuse<Message>(context, call, admission);
    const auto audited = [open, audit = Audit(log_, loop_->clock(), *context, call, admission)](
                             auto wake, auto opened) {
      audit.Begin([open, wake, opened](bool written) {
        if (!written) return opened(MakeError(Reason::kAuditFailed));
        open(wake, opened);
      });
    };
    return StreamReactor<Message>::Start(loop_, context, std::move(label),
                                         std::move(admission.held), audited);
  }

  /// The loop of all streams.
  const StreamLoop& loop() const { return *loop_; }

 private:
  /// A stream that ends at once as the guard says.
  template <class Message>
  grpc::ServerWriteReactor<Message>* Refuse(grpc::CallbackServerContext* context, const Call& call,
                                            const Admission& admission) {
    Audit(log_, loop_->clock(), *context, call, admission).End(Result<bool>(*admission.refusal));
    return StreamReactor<Message>::Refuse(loop_, context, *admission.refusal);
  }

  /// What `opened` does, with a source that asks for the right to read it again and again.
  template <class Message>
  Callback<std::unique_ptr<StreamSource<Message>>> Rightful(
      Callback<std::unique_ptr<StreamSource<Message>>> opened, Right right) const {
    if (!right) return opened;
    return [this, opened = std::move(opened),
            right = std::move(right)](Result<std::unique_ptr<StreamSource<Message>>> source) {
      if (source.ok()) {
        source.value() = std::make_unique<RightfulSource<Message>>(std::move(source.value()), right,
                                                                   loop_->clock());
      }
      opened(std::move(source));
    };
  }

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
  const std::shared_ptr<AuditLog> log_;
};

}  // namespace contact
