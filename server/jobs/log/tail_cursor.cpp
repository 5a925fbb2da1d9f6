#include "jobs/log/tail_cursor.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <utility>

namespace contact {
namespace {

// Bytes of a page of a reader that reads ahead.
constexpr std::size_t kPageBytes = 1 << 20;

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

TailCursor::TailCursor(EventSource source, std::string name, std::shared_ptr<JobLog> log,
                       std::uint64_t position, std::uint32_t kinds, Wake wake, Places::Place place)
    : source_(std::move(source)),
      name_(std::move(name)),
      log_(std::move(log)),
      kinds_(kinds),
      waker_(std::make_shared<const Wake>(std::move(wake))),
      place_(std::move(place)),
      position_(position) {}

TailCursor::~TailCursor() { log_->Forget(waker_); }

LogCursor::Next TailCursor::Read(std::size_t max_bytes, Events* out) {
  for (;;) {
    if (HandOut(max_bytes, out)) return Next::kEvents;
    if (fetch_) {
      if (const auto next = TakeFetched(max_bytes)) return *next;
      continue;
    }
    // Asked anew each time: what was in memory a moment ago may be in the store only by now.
    JobLog::Tail tail = log_->After({position_, kinds_, max_bytes}, &progress_seen_, waker_);
    position_ = tail.position;
    if (tail.found != JobLog::Tail::Found::kOlder) {
      lag_ = 0;
      ahead_ = nullptr;
    }
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
        if (!ahead_) ahead_ = source_.ahead.Take();
        page_ = {{}, {}, position_, oldest_};
        handed_out_ = 0;
        StartFetch(max_bytes);
    }
  }
}

TailCursor::Page TailCursor::Decode(const std::string& name, absl::StatusOr<EventPage> stored) {
  if (!stored.ok()) return {stored.status(), {}};
  Page page{{}, {}, stored->position, stored->oldest};
  for (StoredEvent& event : stored->events) {
    std::string payload;
    if (event.TakePayload(&payload)) {
      page.events.push_back(
          {event.sequence, event.kind, std::make_shared<const std::string>(std::move(payload))});
    } else {
      page.events.push_back(ReportDamage(name, event.sequence));
    }
  }
  return page;
}

void TailCursor::StartFetch(std::size_t max_bytes) {
  fetch_ = std::make_shared<Fetch>();
  const std::weak_ptr<Fetch> weak = fetch_;  // Gone if the reader leaves first.
  auto decode = [weak, name = name_, waker = waker_](absl::StatusOr<EventPage> stored) {
    if (weak.expired()) return;
    Page page = Decode(name, std::move(stored));
    const auto fetch = weak.lock();
    if (!fetch) return;
    {
      const MutexLock lock(fetch->mutex);
      fetch->page = std::move(page);
    }
    (*waker)();
  };
  source_.store.ReadEvents(
      {.name = name_,
       .after = page_.position,
       .kinds = kinds_,
       .max_bytes = ahead_ ? kPageBytes : max_bytes,
       .abandoned = [weak] { return weak.expired(); }},
      [weak, &decoder = source_.decoder, decode](absl::StatusOr<EventPage> stored) {
        if (weak.expired()) return;
        decoder.Post([decode, stored = std::move(stored)]() mutable { decode(std::move(stored)); });
      });
}

std::optional<LogCursor::Next> TailCursor::TakeFetched(std::size_t max_bytes) {
  {
    const MutexLock lock(fetch_->mutex);
    if (!fetch_->page) return Next::kWait;
    page_ = *std::exchange(fetch_->page, std::nullopt);
  }
  handed_out_ = 0;
  fetch_ = nullptr;
  if (absl::IsNotFound(page_.status)) return Next::kDeleted;
  if (!page_.status.ok()) return Next::kFailed;
  oldest_ = page_.oldest;
  const bool frames = (kinds_ & KindBit(v1::Event::kFrameChunk)) != 0;
  if (frames && position_ + 1 < oldest_) return Next::kCompacted;
  if (ahead_ && log_->IsOlder(page_.position)) StartFetch(max_bytes);
  if (page_.events.empty()) position_ = page_.position;
  return std::nullopt;
}

bool TailCursor::HandOut(std::size_t max_bytes, Events* out) {
  if (handed_out_ == page_.events.size()) return false;
  for (std::size_t bytes = 0; handed_out_ < page_.events.size() && bytes < max_bytes;) {
    LogRecord& event = page_.events[handed_out_++];
    position_ = event.sequence;
    bytes += event.event->size();
    lag_ += event.event->size();
    out->push_back(std::move(event));
  }
  if (handed_out_ == page_.events.size()) position_ = page_.position;
  return true;
}

}  // namespace contact
