#pragma once

#include <grpcpp/grpcpp.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "rpc/call/status.h"
#include "rpc/stream/watch_loop.h"

namespace contact {

/// Statuses with which any stream may end.
grpc::Status StreamDraining();
grpc::Status StreamUnreadable(const std::string& what);

/// One call that streams `Message`s, at most one of them under way.
///
/// Source, gRPC and clock all enter through Step, which under the one mutex makes the change and,
/// if no operation is under way, chooses the next one; it is started after the mutex is released.
/// So there is never a second write, never a Finish beside a write, and exactly one Finish.
template <class Message>
class StreamReactor : public grpc::ServerWriteReactor<Message>, public Stream {
 public:
  /// Looks whether there is something to send.
  void Poke() final {
    Step([] {});
  }

  /// Ends the stream with SERVER_DRAINING, after the write under way.
  void Drain() final {
    Step([this] { EndWith(StreamDraining()); });
  }

  /// Ends the call if its write takes longer than `write_stall`; pokes it if it asks for that.
  /// True if a write takes longer than a second.
  bool Tick(std::chrono::steady_clock::time_point now) final;

 protected:
  /// `job` is what is read of, for the log.
  StreamReactor(std::string job, grpc::CallbackServerContext* context,
                std::chrono::milliseconds write_stall, std::shared_ptr<StreamMetrics> metrics)
      : job_(std::move(job)),
        write_stall_(write_stall),
        metrics_(std::move(metrics)),
        context_(context) {}

  /// From here on the reactor owns itself, until gRPC is done with it.
  void Own(std::shared_ptr<StreamReactor> self) { self_ = std::move(self); }

  /// Makes a change of what the derived class guards by the mutex, and starts what follows from it.
  template <class Change>
  void Step(Change change);

  // The rest is called under the mutex.

  /// Puts the next message into `out`, which is empty. False: there is none, now or, after
  /// EndWith, ever.
  virtual bool Next(Message* out) = 0;
  /// True if time alone may bring something to send to a stream without a write under way.
  virtual bool IsDue(std::chrono::steady_clock::time_point now) const = 0;

  /// Ends the stream with this status, unless it has another one.
  void EndWith(const grpc::Status& status) {
    if (!end_) end_ = status;
  }
  std::chrono::steady_clock::time_point last_write() const { return last_write_; }
  StreamMetrics& metrics() { return *metrics_; }

 private:
  enum class State { kIdle, kWriting, kFinishing, kDone };

  State Choose();
  void Drop(std::chrono::steady_clock::time_point now);
  std::shared_ptr<StreamReactor> Self() {
    const std::lock_guard lock(mutex_);
    return self_;
  }

  void OnWriteDone(bool ok) final {
    Step([this, ok] {
      state_ = State::kIdle;
      if (!ok) EndWith(grpc::Status::CANCELLED);
    });
  }
  void OnCancel() final {
    Step([this] { EndWith(grpc::Status::CANCELLED); });
  }
  void OnDone() final {
    std::shared_ptr<StreamReactor> last;  // Goes after the lock.
    const std::lock_guard lock(mutex_);
    state_ = State::kDone;
    last = std::move(self_);
  }

  const std::string job_;
  const std::chrono::milliseconds write_stall_;
  const std::shared_ptr<StreamMetrics> metrics_;

  std::mutex mutex_;                            // Guards everything below.
  grpc::CallbackServerContext* const context_;  // Valid until kDone.
  State state_ = State::kIdle;
  std::optional<grpc::Status> end_;  // Finish with it when idle.
  Message out_;                      // Belongs to gRPC while kWriting.
  std::chrono::steady_clock::time_point last_write_ = std::chrono::steady_clock::now();
  std::shared_ptr<StreamReactor> self_;  // Until kDone.
};

template <class Message>
bool StreamReactor<Message>::Tick(std::chrono::steady_clock::time_point now) {
  bool slow = false;
  {
    const std::lock_guard lock(mutex_);
    if (state_ == State::kWriting) {
      const auto waits = now - last_write_;
      slow = waits > std::chrono::seconds(1);
      if (waits > write_stall_) Drop(now);
    }
    if (state_ != State::kIdle || !IsDue(now)) return slow;
  }
  Poke();
  return slow;
}

template <class Message>
void StreamReactor<Message>::Drop(std::chrono::steady_clock::time_point now) {
  spdlog::warn("job={} a reader took nothing for {} ms and is dropped", job_, write_stall_.count());
  ++metrics_->dropped;
  context_->TryCancel();
  last_write_ = now;
}

template <class Message>
template <class Change>
void StreamReactor<Message>::Step(Change change) {
  const auto keep = Self();
  if (!keep) return;
  const auto begin = std::chrono::steady_clock::now();
  State next;
  grpc::Status end;
  {
    const std::lock_guard lock(mutex_);
    change();
    if (state_ != State::kIdle) return;  // OnWriteDone comes back here.
    state_ = next = Choose();
    if (next == State::kWriting) last_write_ = std::chrono::steady_clock::now();
    if (next == State::kFinishing) end = *end_;
  }
  if (next == State::kWriting) this->StartWrite(&out_);
  if (next == State::kFinishing) this->Finish(end);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  metrics_->reaction_seconds.Count(took.count());
}

template <class Message>
typename StreamReactor<Message>::State StreamReactor<Message>::Choose() {
  if (!end_) {
    out_.Clear();
    if (Next(&out_)) return State::kWriting;
  }
  return end_ ? State::kFinishing : State::kIdle;
}

}  // namespace contact
