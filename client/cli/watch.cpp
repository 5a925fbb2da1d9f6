#include "cli/watch.h"

#include <algorithm>
#include <random>
#include <thread>

#include "cli/watch_call.h"

namespace contact::cli {
namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::milliseconds;

constexpr Milliseconds kTick{100};

// Ends of a stream after which the same question may be asked again.
bool MayTryAgain(grpc::StatusCode code) {
  switch (code) {
    case grpc::StatusCode::OK:  // Without the final event: a proxy or a dying server.
    case grpc::StatusCode::UNAVAILABLE:
    case grpc::StatusCode::CANCELLED:
    case grpc::StatusCode::UNKNOWN:
    case grpc::StatusCode::INTERNAL:
    case grpc::StatusCode::ABORTED:
    case grpc::StatusCode::DEADLINE_EXCEEDED:
    case grpc::StatusCode::RESOURCE_EXHAUSTED:
      return true;
    default:
      return false;
  }
}

// One watch over all its connections.
class Watcher {
 public:
  Watcher(Client& client, const WatchOptions& options, WatchObserver& observer)
      : client_(client),
        options_(options),
        observer_(observer),
        position_(options.after_sequence),
        pause_(options.first_pause) {}

  WatchEnd Follow() {
    while (true) {
      const grpc::Status status = Connect();
      if (end_) return *end_;
      RequireHope(status);
      const Milliseconds pause = NextPause();
      observer_.OnLost(status.ok() ? "the stream ended early" : status.error_message(), pause);
      Rest(pause);
      if (end_) return *end_;
    }
  }

 private:
  // Reads one stream until it ends or the watch does.
  grpc::Status Connect() {
    v1::WatchJobRequest request;
    request.set_name(options_.name);
    request.set_after_sequence(position_);
    for (const std::string& kind : options_.kinds) request.add_kinds(kind);
    WatchCall call(client_.stub(), request);
    v1::WatchJobResponse message;
    while (GoOn()) {
      const WatchCall::Next next = call.Read(kTick, &message);
      if (next == WatchCall::Next::kMessage) Take(message);
      if (next == WatchCall::Next::kEnd) {
        if (call.status().ok() && heard_all_) end_ = WatchEnd::kFinished;
        return call.status();
      }
      if (final_event_) end_ = WatchEnd::kFinished;
    }
    return grpc::Status::OK;
  }

  void Take(const v1::WatchJobResponse& message) {
    connected_ = true;
    lost_since_.reset();
    pause_ = options_.first_pause;
    if (message.has_snapshot()) {
      observer_.OnSnapshot(message.snapshot());
      // Asked for events after the last one: nothing but the end of the stream will come.
      heard_all_ =
          IsFinal(message.snapshot().state()) && position_ >= message.snapshot().last_sequence();
    }
    for (const v1::Event& event : message.events()) Take(event);
  }

  void Take(const v1::Event& event) {
    const bool numbered = event.sequence() > 0;
    if (numbered && event.sequence() <= position_ && !event.has_bookmark() && !event.has_gap()) {
      return;  // Heard before the connection was lost.
    }
    position_ = std::max(position_, event.sequence());
    observer_.OnEvent(event);
    final_event_ |= event.has_state_changed() && IsFinal(event.state_changed().state());
  }

  // False when the watch ends; tells the observer the time otherwise.
  bool GoOn() {
    if (end_) return false;
    if (options_.stopped()) {
      end_ = WatchEnd::kStopped;
    } else if (options_.deadline && Clock::now() >= *options_.deadline) {
      end_ = WatchEnd::kTimedOut;
    } else {
      observer_.OnTick();
    }
    return !end_;
  }

  void RequireHope(const grpc::Status& status) {
    const bool overload = status.error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED;
    if (!MayTryAgain(status.error_code()) || (!connected_ && (overload || Unreached(status)))) {
      throw CallFailure(status, client_.server());
    }
    if (!lost_since_) lost_since_ = Clock::now();
    if (Clock::now() - *lost_since_ > options_.give_up_after) {
      throw CallFailure(
          status.ok() ? grpc::Status(grpc::StatusCode::UNAVAILABLE, "no answer") : status,
          client_.server());
    }
  }

  static bool Unreached(const grpc::Status& status) {
    return status.error_code() == grpc::StatusCode::UNAVAILABLE && status.error_details().empty();
  }

  // From half the pause to all of it, so that watchers of a restarted server do not come at once.
  Milliseconds NextPause() {
    std::uniform_real_distribution<double> jitter(0.5, 1.0);
    const auto pause = std::chrono::duration_cast<Milliseconds>(pause_ * jitter(random_));
    pause_ = std::min(2 * pause_, options_.longest_pause);
    return pause;
  }

  void Rest(Milliseconds pause) {
    const auto until = Clock::now() + pause;
    while (Clock::now() < until && GoOn()) {
      std::this_thread::sleep_for(
          std::min<Clock::duration>(kTick, std::max<Clock::duration>(until - Clock::now(), {})));
    }
  }

  Client& client_;
  const WatchOptions& options_;
  WatchObserver& observer_;
  std::uint64_t position_;
  Milliseconds pause_;
  std::optional<Clock::time_point> lost_since_;
  std::optional<WatchEnd> end_;
  bool connected_ = false;    // Ever.
  bool heard_all_ = false;    // The snapshot shows an ended job without later events.
  bool final_event_ = false;  // The state_changed event of a final state came.
  std::mt19937 random_{std::random_device{}()};
};

}  // namespace

WatchEnd Watch(Client& client, const WatchOptions& options, WatchObserver& observer) {
  return Watcher(client, options, observer).Follow();
}

bool IsFinal(v1::Job::State state) {
  return state == v1::Job::SUCCEEDED || state == v1::Job::FAILED || state == v1::Job::CANCELLED;
}

}  // namespace contact::cli
