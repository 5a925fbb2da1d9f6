#include "jobs/tail_cursor.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <utility>

namespace contact {
namespace {

// The reader learns in place of a damaged event that there was one.
LogRecord ReportDamage(const std::string& name, std::uint64_t sequence) {
  spdlog::error("job={} event={} fails its checksum", name, sequence);
  v1::Event event;
  event.mutable_log_entry()->set_severity(v1::LogEntry::WARNING);
  event.mutable_log_entry()->set_message(
      fmt::format("event {} is damaged in the store and lost", sequence));
  return ToRecord(sequence, std::move(event));
}

}  // namespace

TailCursor::TailCursor(Store& store, std::string name, std::shared_ptr<JobLog> log,
                       std::uint64_t position, std::uint32_t kinds, JobLog::Waker wake,
                       std::shared_ptr<std::atomic<int>> watchers)
    : store_(store),
      name_(std::move(name)),
      log_(std::move(log)),
      kinds_(kinds),
      waker_(std::make_shared<const JobLog::Waker>(std::move(wake))),
      watchers_(std::move(watchers)),
      position_(position) {}

TailCursor::~TailCursor() {
  log_->Forget(waker_);
  --*watchers_;
}

LogCursor::Next TailCursor::Read(std::size_t max_bytes, Events* out) {
  for (;;) {
    if (fetch_) {
      if (const auto next = ReadFetched(out)) return *next;
    }
    // Asked anew each time: what was in memory a moment ago may be in the store only by now.
    JobLog::Tail tail = log_->After({position_, kinds_, max_bytes}, &progress_seen_, waker_);
    position_ = tail.position;
    if (tail.found != JobLog::Tail::Found::kOlder) lag_ = 0;
    switch (tail.found) {
      case JobLog::Tail::Found::kEvents:
        for (LogRecord& event : tail.events) out->push_back(std::move(event));
        return Next::kEvents;
      case JobLog::Tail::Found::kNothing:
        live_ = true;
        return Next::kWait;
      case JobLog::Tail::Found::kEnd:
        return Next::kEnd;
      case JobLog::Tail::Found::kFailed:
        return Next::kFailed;
      case JobLog::Tail::Found::kOlder:
        StartFetch(max_bytes);
    }
  }
}

void TailCursor::StartFetch(std::size_t max_bytes) {
  fetch_ = std::make_shared<Fetch>();
  const std::weak_ptr<Fetch> weak = fetch_;  // Gone if the reader leaves first.
  store_.ReadEvents({name_, position_, kinds_, max_bytes},
                    [weak, waker = waker_](absl::StatusOr<EventPage> page) {
                      const auto fetch = weak.lock();
                      if (!fetch) return;
                      {
                        const MutexLock lock(fetch->mutex);
                        fetch->page = std::move(page);
                      }
                      (*waker)();
                    });
}

// Nothing if the page is read and held no event that was asked for.
std::optional<LogCursor::Next> TailCursor::ReadFetched(Events* out) {
  std::optional<absl::StatusOr<EventPage>> page;
  {
    const MutexLock lock(fetch_->mutex);
    if (!fetch_->page) return Next::kWait;
    page = std::move(fetch_->page);
  }
  fetch_ = nullptr;
  if (absl::IsNotFound(page->status())) return Next::kDeleted;
  if (!page->ok()) return Next::kFailed;
  oldest_ = (*page)->oldest;
  if ((kinds_ & KindBit(v1::Event::kFrameChunk)) && position_ + 1 < oldest_)
    return Next::kCompacted;
  position_ = (*page)->position;
  for (StoredEvent& stored : (*page)->events) {
    std::string payload;
    if (!stored.TakePayload(&payload)) {
      out->push_back(ReportDamage(name_, stored.sequence));
      continue;
    }
    lag_ += payload.size();
    out->push_back(
        {stored.sequence, stored.kind, std::make_shared<const std::string>(std::move(payload))});
  }
  if ((*page)->events.empty()) return std::nullopt;
  return Next::kEvents;
}

}  // namespace contact
