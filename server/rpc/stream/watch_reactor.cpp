#include "rpc/stream/watch_reactor.h"

#include <grpcpp/impl/codegen/proto_utils.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "jobs/job/job_errors.h"
#include "rpc/call/status.h"

namespace contact {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr std::size_t kMaxBatchBytes = std::size_t{256} * 1024;

grpc::Status Unparsable() {
  return ToGrpc({.code = absl::StatusCode::kInvalidArgument,
                 .reason = "FIELD_INVALID",
                 .message = "the request is no WatchJobRequest"});
}

grpc::Status Deleted(const std::string& name) {
  return ToGrpc({.code = absl::StatusCode::kNotFound,
                 .reason = "JOB_NOT_FOUND",
                 .message = name + " was deleted",
                 .metadata = {{"name", name}}});
}

// Events in whose place the record stands, if it is a gap.
std::int64_t LeftOut(const LogRecord& record) {
  v1::Event event;
  if (record.kind != v1::Event::kGap || !event.ParseFromString(*record.event)) return 0;
  return static_cast<std::int64_t>(event.gap().dropped_count());
}

}  // namespace

WatchReactor* WatchReactor::Start(JobManager& jobs, const std::shared_ptr<WatchLoop>& loop,
                                  grpc::CallbackServerContext* context,
                                  const grpc::ByteBuffer& request, milliseconds write_stall) {
  v1::WatchJobRequest parsed;
  grpc::ByteBuffer bytes = request;
  const bool readable =
      grpc::SerializationTraits<v1::WatchJobRequest>::Deserialize(&bytes, &parsed).ok();
  const std::shared_ptr<WatchReactor> self(
      new WatchReactor(context, parsed.name(), write_stall, loop->metrics()));
  self->Own(self);
  if (!readable) {
    self->Step([&self] { self->EndWith(Unparsable()); });
    return self.get();  // Alive: gRPC calls OnDone only after it has been given the reactor.
  }
  const std::weak_ptr<WatchReactor> weak = self;
  loop->Add(self);
  jobs.Watch(
      parsed, [stream = std::weak_ptr<Stream>(self), loop] { loop->Wake(stream); },
      [weak](Result<JobManager::Watched> result) {
        const auto watcher = weak.lock();
        if (!watcher) return;
        watcher->Step([&] {
          if (!result.ok()) return watcher->EndWith(ToGrpc(result.error()));
          watcher->watched_ = std::move(result.value());
          watcher->snapshot_ = std::move(watcher->watched_.snapshot);
          watcher->last_told_ = steady_clock::now();
        });
      });
  return self.get();
}

WatchReactor::WatchReactor(grpc::CallbackServerContext* context, const std::string& name,
                           milliseconds write_stall, std::shared_ptr<StreamMetrics> metrics)
    : StreamReactor(name, context, write_stall, std::move(metrics)), name_(name) {}

// Puts what comes next into `out`, or ends the stream.
bool WatchReactor::Next(grpc::ByteBuffer* out) {
  if (!watched_.cursor) return false;
  if (snapshot_) {
    WatchMessage message;
    message.SetSnapshot(*std::exchange(snapshot_, std::nullopt));
    *out = message.Take();
    return true;
  }
  std::vector<LogRecord> records;
  switch (watched_.cursor->Read(kMaxBatchBytes, &records)) {
    case LogCursor::Next::kEvents:
    case LogCursor::Next::kWait:
      return Write(records, out);
    case LogCursor::Next::kEnd:
      EndWith(grpc::Status::OK);
      return false;
    case LogCursor::Next::kDeleted:
      EndWith(Deleted(name_));
      return false;
    case LogCursor::Next::kCompacted:
      EndWith(ToGrpc(EventsCompacted(name_, watched_.cursor->oldest())));
      return false;
    case LogCursor::Next::kSlow:
      EndWith(ToGrpc(SlowWatcher(name_)));
      return false;
    case LogCursor::Next::kFailed:
      EndWith(StreamUnreadable(name_));
      return false;
  }
  return false;
}

// Adds a bookmark if it is time for one: progress alone tells no place to resume from.
bool WatchReactor::Write(const std::vector<LogRecord>& records, grpc::ByteBuffer* out) {
  WatchMessage message;
  for (const LogRecord& record : records) {
    message.Add(record);
    metrics().conflated += LeftOut(record);
  }
  const auto now = steady_clock::now();
  const bool told = std::ranges::any_of(records, [](const auto& r) { return r.sequence > 0; });
  const bool bookmark = !told && now - last_told_ >= watched_.bookmark_interval;
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

bool WatchReactor::IsDue(steady_clock::time_point now) const {
  return watched_.cursor && (watched_.paced || now - last_told_ >= watched_.bookmark_interval);
}

}  // namespace contact
