#include "cli/link/watch.h"

#include <google/protobuf/util/time_util.h>

#include <algorithm>
#include <utility>

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

}  // namespace

WatchEnd Watch(Client& client, const WatchOptions& options, WatchObserver& observer) {
  return Watcher(client, options, observer).Follow();
}

bool IsFinal(v1::Job::State state) {
  return state == v1::Job::SUCCEEDED || state == v1::Job::FAILED || state == v1::Job::CANCELLED;
}

}  // namespace contact::cli
