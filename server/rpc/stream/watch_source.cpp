#include "rpc/stream/watch_source.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "jobs/job/errors.h"
#include "rpc/call/status.h"
#include "rpc/stream/watch_message.h"

namespace contact {
namespace {

using std::chrono::steady_clock;

constexpr std::size_t kMaxBatchBytes = std::size_t{256} * 1024;

// Number of events that a gap stands for; 0 for every other record.
std::int64_t LeftOut(const LogRecord& record) {
  v1::Event event;
  if (record.kind != v1::Event::kGap || !event.ParseFromString(*record.event)) return 0;
  return static_cast<std::int64_t>(event.gap().dropped_count());
}

class WatchSource final : public StreamSource<grpc::ByteBuffer> {
 public:
  WatchSource(JobManager::Watched watched, std::string name, const Clock& clock,
              StreamMetrics& metrics)
      : cursor_(std::move(watched.cursor)),
        bookmark_interval_(watched.bookmark_interval),
        paced_(watched.paced),
        name_(std::move(name)),
        clock_(clock),
        metrics_(metrics),
        snapshot_(std::move(watched.snapshot)),
        last_told_(clock.Elapsed()) {}

  StreamStep Read(grpc::ByteBuffer* out) override {
    if (snapshot_) return SendSnapshot(out);
    std::vector<LogRecord> records;
    switch (cursor_->Read(kMaxBatchBytes, &records)) {
      case LogCursor::Next::kEvents:
      case LogCursor::Next::kWait:
        return {.has_message = Write(records, out)};
      case LogCursor::Next::kEnd:
        return {.end = grpc::Status::OK};
      case LogCursor::Next::kDeleted:
        return {.end = ToGrpc(Deleted(name_))};
      case LogCursor::Next::kCompacted:
        return {.end = ToGrpc(EventsCompacted(name_, cursor_->oldest()))};
      case LogCursor::Next::kSlow:
        return {.end = ToGrpc(SlowWatcher(name_))};
      case LogCursor::Next::kFailed:
        return {.end = ToGrpc(Unreadable(name_))};
    }
    return {};
  }

  bool IsDue(steady_clock::time_point now) const override { return paced_ || NeedsBookmark(now); }

 private:
  StreamStep SendSnapshot(grpc::ByteBuffer* out) {
    WatchMessage message;
    message.SetSnapshot(*std::exchange(snapshot_, std::nullopt));
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
      message.Add(ToRecord(cursor_->position(), std::move(event)));
    }
    if (told || bookmark) last_told_ = now;
    if (records.empty() && !bookmark) return false;
    *out = message.Take();
    return true;
  }

  bool NeedsBookmark(steady_clock::time_point now) const {
    return now - last_told_ >= bookmark_interval_;
  }

  const std::unique_ptr<LogCursor> cursor_;
  const std::chrono::milliseconds bookmark_interval_;
  const bool paced_;
  const std::string name_;
  const Clock& clock_;
  StreamMetrics& metrics_;
  std::optional<v1::Job> snapshot_;     // Until it is sent.
  steady_clock::time_point last_told_;  // When a place to resume from was sent.
};

}  // namespace

std::unique_ptr<StreamSource<grpc::ByteBuffer>> MakeWatchSource(JobManager::Watched watched,
                                                                std::string name,
                                                                const Clock& clock,
                                                                StreamMetrics& metrics) {
  return std::make_unique<WatchSource>(std::move(watched), std::move(name), clock, metrics);
}

}  // namespace contact
