#include "cli/link/watch.h"

#include <fmt/format.h>
#include <google/protobuf/util/time_util.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "cli/base/interrupt.h"
#include "cli/base/message.h"
#include "cli/link/stream_call.h"
#include "cli/link/stream_watch.h"

namespace contact::cli {
namespace {

class Watcher final : public StreamWatch<WatchOptions, WatchObserver> {
 public:
  Watcher(Client& client, const WatchOptions& options, WatchObserver& observer)
      : StreamWatch(client, options, observer),
        position_(options.after_sequence),
        live_only_(options.live_only) {}

 private:
  using Call = StreamCall<v1::WatchJobResponse>;

  v1::WatchJobRequest Request() const {
    v1::WatchJobRequest request;
    request.set_name(options_.name);
    request.set_after_sequence(position_);
    for (const std::string& kind : options_.kinds) request.add_kinds(kind);
    request.mutable_delivery()->set_overflow(options_.overflow);
    *request.mutable_delivery()->mutable_min_frame_interval() =
        google::protobuf::util::TimeUtil::MillisecondsToDuration(
            options_.min_frame_interval.count());
    request.set_live_only(live_only_);
    return request;
  }

  grpc::Status Connect() override {
    const v1::WatchJobRequest request = Request();
    Call call([&](auto* context, auto* queue, void* tag) {
      return client_.stub().AsyncWatchJob(context, request, queue, tag);
    });
    v1::WatchJobResponse message;
    while (GoOn()) {
      const Call::Next next = call.Read(kStreamTick, &message);
      if (next == Call::Next::kMessage) Take(message);
      if (next == Call::Next::kEnd) {
        if (call.status().ok() && heard_all_) end_ = WatchEnd::kFinished;
        return call.status();
      }
      if (final_event_) end_ = WatchEnd::kFinished;
    }
    return grpc::Status::OK;
  }

  void Take(const v1::WatchJobResponse& message) {
    Heard();
    if (message.has_snapshot()) Take(message.snapshot());
    for (const v1::Event& event : message.events()) Take(event);
  }

  void Take(const v1::Job& snapshot) {
    observer_.OnSnapshot(snapshot);
    if (std::exchange(live_only_, false)) position_ = snapshot.last_sequence();
    // Asked for events after the last one: nothing but the end of the stream will come.
    heard_all_ = IsFinal(snapshot.state()) && position_ >= snapshot.last_sequence();
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

  std::uint64_t position_;
  bool live_only_;            // Has not begun yet.
  bool heard_all_ = false;    // The snapshot shows an ended job without later events.
  bool final_event_ = false;  // The state_changed event of a final state came.
};

// Passes on what comes, and says on the standard error why nothing does.
class Announcer final : public WatchObserver {
 public:
  Announcer(std::string job, WatchObserver& observer) : job_(std::move(job)), observer_(observer) {}

  void OnSnapshot(const v1::Job& job) override {
    state_ = job.state();
    observer_.OnSnapshot(job);
  }
  void OnEvent(const v1::Event& event) override { observer_.OnEvent(event); }
  void OnLost(const std::string& why) override { TellLost(why); }
  void OnRegained() override { TellRegained(); }
  void OnTick() override {
    constexpr std::chrono::milliseconds kShort{500};  // A wait that needs no words.
    const bool waits = state_ == v1::Job::QUEUED || state_ == v1::Job::RUNNING;
    if (waits && !told_ && std::chrono::steady_clock::now() - start_ > kShort) {
      told_ = true;
      Tell("{} is {}; waiting for its end\n", job_, v1::Job::State_Name(state_));
    }
    observer_.OnTick();
  }

 private:
  const std::string job_;
  WatchObserver& observer_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  v1::Job::State state_ = v1::Job::STATE_UNSPECIFIED;
  bool told_ = false;
};

}  // namespace

WatchEnd Watch(Client& client, const WatchOptions& options, WatchObserver& observer) {
  return Watcher(client, options, observer).Follow();
}

bool IsFinal(v1::Job::State state) {
  return state == v1::Job::SUCCEEDED || state == v1::Job::FAILED || state == v1::Job::CANCELLED;
}

void TellLost(const std::string& why) { Tell("connection lost ({}); trying again\n", why); }

void TellRegained() { Tell("connected again\n"); }

void WatchToEnd(Client& client, WatchOptions options, const Settings& settings,
                WatchObserver& observer) {
  options.deadline = settings.Deadline();
  options.stopped = Interrupt::raised;
  Announcer announcer(options.name, observer);
  const WatchEnd end = Watch(client, options, announcer);
  if (end == WatchEnd::kFinished) return;
  const bool interrupted = end == WatchEnd::kStopped;
  throw Failure(interrupted ? ExitCode::kInterrupted : ExitCode::kTimeout,
                fmt::format("{}; {} has not ended, or is long",
                            interrupted ? "interrupted" : "time is up", options.name));
}

void ReplayWhole(const std::string& job, const std::function<bool()>& replay) {
  constexpr int kTries = 2;
  for (int i = 0; i < kTries; ++i) {
    if (replay()) return;
  }
  throw Failure(ExitCode::kRunFailed,
                fmt::format("parts of the trajectory of {} do not come; try again", job));
}

}  // namespace contact::cli
