#include "rpc/stream/watch_source.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "jobs/job/errors.h"
#include "rpc/stream/watch_message.h"

namespace contact {
namespace {

using std::chrono::steady_clock;

// Number of events that a gap stands for; 0 for every other record.
std::int64_t LeftOut(const LogRecord& record) {
  v1::Event event;
  if (record.kind != v1::Event::kGap || !event.ParseFromString(*record.event)) return 0;
  return static_cast<std::int64_t>(event.gap().dropped_count());
}

class WatchSource final : public StreamSource<grpc::ByteBuffer> {
 public:
  WatchSource(WatchedJob watched, const Clock& clock, StreamMetrics& metrics)
      : name_(watched.snapshot.name()),
        watched_(std::move(watched)),
        clock_(clock),
        metrics_(metrics),
        last_told_(clock.Elapsed()) {}

  StreamStep Read(grpc::ByteBuffer* out) override {
    if (!std::exchange(snapshot_sent_, true)) return SendSnapshot(out);
    std::vector<LogRecord> records;
    switch (watched_.cursor->Read(watched_.message_bytes(), &records)) {
      case LogCursor::Next::kEvents:
      case LogCursor::Next::kWait:
        return {.has_message = Write(records, out)};
      case LogCursor::Next::kEnd:
        return {.ended = true};
      case LogCursor::Next::kDeleted:
        return {.error = JobError(Reason::kJobNotFound, name_, "was deleted")};
      case LogCursor::Next::kCompacted:
        return {.error = EventsCompacted(name_, watched_.cursor->oldest())};
      case LogCursor::Next::kSlow:
        return {.error = SlowWatcher(name_)};
      case LogCursor::Next::kFailed:
        return {.error = Unreadable(name_)};
    }
    return {};
  }

  bool IsDue(steady_clock::time_point now) const override {
    return watched_.paced || NeedsBookmark(now);
  }

 private:
  StreamStep SendSnapshot(grpc::ByteBuffer* out) {
    WatchMessage message;
    message.SetSnapshot(std::exchange(watched_.snapshot, {}));  // It may be large.
    *out = message.Take();
    return {.has_message = true};
  }

  // Adds a bookmark when it is time for one. A record without sequence, such as progress, tells no
  // place to resume from.
  bool Write(const std::vector<LogRecord>& records, grpc::ByteBuffer* out) {
    WatchMessage message;
    for (const LogRecord& record : records) {
      message.Add(record);
      metrics_.conflated += LeftOut(record);
    }
    const auto now = clock_.Elapsed();
    const bool told = std::ranges::any_of(records, [](const auto& r) { return r.sequence > 0; });
    const bool bookmark = !told && NeedsBookmark(now);
    if (bookmark) {
      v1::Event event;
      event.mutable_bookmark();
      message.Add(ToRecord(watched_.cursor->position(), std::move(event)));
    }
    if (told || bookmark) last_told_ = now;
    if (records.empty() && !bookmark) return false;
    *out = message.Take();
    return true;
  }

  bool NeedsBookmark(steady_clock::time_point now) const {
    return now - last_told_ >= watched_.bookmark_interval;
  }

  const std::string name_;
  WatchedJob watched_;  // Its snapshot is empty once it was sent.
  const Clock& clock_;
  StreamMetrics& metrics_;
  bool snapshot_sent_ = false;
  steady_clock::time_point last_told_;  // When a place to resume from was sent.
};

}  // namespace

std::unique_ptr<StreamSource<grpc::ByteBuffer>> MakeWatchSource(WatchedJob watched,
                                                                const Clock& clock,
                                                                StreamMetrics& metrics) {
  return std::make_unique<WatchSource>(std::move(watched), clock, metrics);
}

}  // namespace contact
