#pragma once

#include <grpcpp/grpcpp.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "base/mutex.h"
#include "jobs/job/errors.h"
#include "jobs/log/stream_source.h"
#include "rpc/call/status.h"
#include "rpc/stream/stream_loop.h"

namespace contact {

/// One call that streams the messages of a source, at most one of them under way.
///
/// Source, gRPC and clock change the state under the one mutex and then call Advance, which, if no
/// operation is under way, chooses the next one under the mutex and starts it after the mutex is
/// released. So there is never a second write, never a Finish beside a write, and exactly one
/// Finish.
template <class Message>
class StreamReactor final : public grpc::ServerWriteReactor<Message>, public Stream {
 public:
  using Source = std::unique_ptr<StreamSource<Message>>;

  /// Starts the call, which owns itself until gRPC is done with it. `open(wake, opened)` is called
  /// once, at once; what it starts calls `opened` with a Result<Source>, once, at any time, on any
  /// thread. The source may call `wake` at any time, also after the stream's end. `label` names in
  /// the log what is read. `held` goes when the stream ends.
  template <class Open>
  static StreamReactor* Start(const std::shared_ptr<StreamLoop>& loop,
                              grpc::CallbackServerContext* context, std::string label,
                              std::shared_ptr<const void> held, Open open) {
    const auto self = Make(loop, context, std::move(label), std::move(held));
    loop->Add(self);
    const std::weak_ptr<StreamReactor> weak = self;
    open([weak, loop] { loop->Wake(weak); },
         [weak](Result<Source> source) {
           if (const auto reactor = weak.lock()) reactor->SetSource(std::move(source));
         });
    return self.get();  // Alive: gRPC calls OnDone only after it has been given the reactor.
  }

  /// A call that ends at once with this error.
  static StreamReactor* Refuse(const std::shared_ptr<StreamLoop>& loop,
                               grpc::CallbackServerContext* context, const Error& error) {
    const auto self = Make(loop, context, "", nullptr);
    self->End(ToGrpc(error));
    return self.get();
  }

  /// See Stream.
  void Poke() final { Advance(); }
  void Drain() final { End(ToGrpc(MakeError(Reason::kServerDraining))); }
  bool Tick(std::chrono::steady_clock::time_point now) final {
    bool slow = false;
    {
      const MutexLock lock(mutex_);
      if (state_ == State::kWriting) {
        const auto waits = now - last_write_;
        slow = waits > std::chrono::seconds(1);
        if (waits > loop_->write_stall()) Drop(now);
      }
      if (state_ != State::kIdle || !source_ || !source_->IsDue(now)) return slow;
    }
    Advance();
    return slow;
  }

 private:
  /// The operation of gRPC that is under way; kDone once gRPC is done with the call.
  enum class State { kIdle, kWriting, kFinishing, kDone };

  StreamReactor(std::string label, grpc::CallbackServerContext* context,
                std::shared_ptr<StreamLoop> loop, std::shared_ptr<const void> held)
      : label_(std::move(label)),
        loop_(std::move(loop)),
        context_(context),
        held_(std::move(held)),
        last_write_(loop_->clock().Elapsed()) {}

  /// A reactor that owns itself.
  static std::shared_ptr<StreamReactor> Make(const std::shared_ptr<StreamLoop>& loop,
                                             grpc::CallbackServerContext* context,
                                             std::string label, std::shared_ptr<const void> held) {
    std::shared_ptr<StreamReactor> self(
        new StreamReactor(std::move(label), context, loop, std::move(held)));
    const MutexLock lock(self->mutex_);
    self->self_ = self;
    return self;
  }

  /// Takes the source, or ends the stream with the error.
  void SetSource(Result<Source> source) {
    if (!source.ok()) return End(ToGrpc(source.error()));
    {
      const MutexLock lock(mutex_);
      source_ = std::move(source.value());
    }
    Advance();
  }

  /// Ends the stream with this status, unless it ends already with another one.
  void End(const grpc::Status& status) {
    {
      const MutexLock lock(mutex_);
      if (!end_) end_ = status;
    }
    Advance();
  }

  /// Starts the next operation if none is under way.
  void Advance() {
    const auto begin = std::chrono::steady_clock::now();
    State next = State::kIdle;
    grpc::Status end;
    // They go before the client learns of the end, and outside of the lock.
    Source read;
    std::shared_ptr<const void> held;
    {
      const MutexLock lock(mutex_);
      if (state_ != State::kIdle) return;  // OnWriteDone comes back here.
      state_ = next = Choose();
      if (next == State::kWriting) last_write_ = loop_->clock().Elapsed();
      if (next == State::kFinishing) {
        end = *end_;
        read = std::move(source_);
        held = std::move(held_);
      }
    }
    read.reset();
    held.reset();
    if (next == State::kWriting) this->StartWrite(&out_);
    if (next == State::kFinishing) this->Finish(end);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    loop_->metrics()->reaction_seconds.Count(took.count());
  }

  /// The next operation: a write of `out_`, Finish with `end_`, or none.
  State Choose() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    if (!end_ && source_) {
      out_.Clear();
      const StreamStep step = source_->Read(&out_);
      if (step.ended) end_ = grpc::Status::OK;
      if (step.error) end_ = ToGrpc(*step.error);
      if (step.has_message) return State::kWriting;
    }
    return end_ ? State::kFinishing : State::kIdle;
  }

  /// Cancels the call of a reader that stalls.
  void Drop(std::chrono::steady_clock::time_point now) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    spdlog::warn("{} a reader took nothing for {} ms and is dropped", label_,
                 loop_->write_stall().count());
    ++loop_->metrics()->dropped;
    context_->TryCancel();
    last_write_ = now;
  }

  /// gRPC has sent the message, or the client has left. On one of gRPC's threads.
  void OnWriteDone(bool ok) final {
    {
      const MutexLock lock(mutex_);
      state_ = State::kIdle;
      if (!ok && !end_) end_ = grpc::Status::CANCELLED;
    }
    Advance();
  }
  /// The client has cancelled, or has left. On one of gRPC's threads.
  void OnCancel() final { End(grpc::Status::CANCELLED); }
  /// gRPC is done with the call: the reactor may go. On one of gRPC's threads.
  void OnDone() final {
    std::shared_ptr<StreamReactor> last;  // Goes after the lock.
    const MutexLock lock(mutex_);
    state_ = State::kDone;
    last = std::move(self_);
  }

  /// What is read, for the log.
  const std::string label_;
  const std::shared_ptr<StreamLoop> loop_;
  /// Valid until kDone.
  grpc::CallbackServerContext* const context_;

  Mutex mutex_;
  State state_ ABSL_GUARDED_BY(mutex_) = State::kIdle;
  /// Null until opened, and from kFinishing on.
  Source source_ ABSL_GUARDED_BY(mutex_);
  /// What the stream takes of its caller's limits. Null from kFinishing on.
  std::shared_ptr<const void> held_ ABSL_GUARDED_BY(mutex_);
  /// To finish with when idle. Nothing while the stream goes on.
  std::optional<grpc::Status> end_ ABSL_GUARDED_BY(mutex_);
  /// Start of the last write.
  std::chrono::steady_clock::time_point last_write_ ABSL_GUARDED_BY(mutex_);
  /// Null from kDone on.
  std::shared_ptr<StreamReactor> self_ ABSL_GUARDED_BY(mutex_);
  /// The message under way. Guarded by mutex_ except while kWriting, when gRPC reads it.
  Message out_;
};

}  // namespace contact
