#include "jobs/log/job_log.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "jobs/job/lifecycle.h"
#include "storage/records.h"

namespace contact {
namespace {

constexpr std::size_t kMaxEvents = 4096;
constexpr std::size_t kMaxBytes = 1 << 20;

bool Ends(const LogRecord& record) {
  v1::Event event;
  return record.kind == v1::Event::kStateChanged && event.ParseFromString(*record.event) &&
         IsFinal(event.state_changed().state());
}

}  // namespace

LogRecord ToRecord(std::uint64_t sequence, v1::Event event) {
  event.clear_sequence();
  return {sequence, event.payload_case(),
          std::make_shared<const std::string>(event.SerializeAsString())};
}

std::vector<LogRecord> ToRecords(std::vector<v1::Event> events) {
  std::vector<LogRecord> records;
  records.reserve(events.size());
  for (v1::Event& event : events) records.push_back(ToRecord(0, std::move(event)));
  return records;
}

template <class Change>
void JobLog::Tell(Change change) {
  Wakers wakers;
  bool moved = false;
  {
    const MutexLock lock(mutex_);
    moved = change();
    wakers = std::exchange(waiting_, {});
  }
  if (moved && on_state_) on_state_();
  for (const auto& waker : wakers) (*waker)();
}

void JobLog::Append(std::uint64_t first, std::vector<LogRecord> records) {
  if (on_end_ && std::ranges::any_of(records, Ends)) on_end_();
  Tell([&]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    bool moved = false;
    for (LogRecord& record : records) {
      record.sequence = first++;
      moved |= record.kind == v1::Event::kStateChanged;
      const bool ended = Ends(record);
      Push(std::move(record), ended);
    }
    return moved;
  });
}

void JobLog::Push(LogRecord record, bool ended) {
  last_ = record.sequence;
  ended_ = ended;
  ring_bytes_ += record.event->size();
  ring_.push_back(std::move(record));
  while (ring_.size() > kMaxEvents || ring_bytes_ > kMaxBytes) {
    ring_bytes_ -= ring_.front().event->size();
    ring_.pop_front();
  }
}

void JobLog::Advance(std::uint64_t last, bool ended) {
  {
    const MutexLock lock(mutex_);
    assert(ring_.empty());
    if (last <= last_ && ended <= ended_) return;
  }
  Tell([&]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    last_ = std::max(last_, last);
    ended_ |= ended;
    return false;
  });
}

void JobLog::SetProgress(v1::Event progress) {
  Tell([&]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    progress_ = ToRecord(0, std::move(progress));
    ++progress_count_;
    return false;
  });
}

void JobLog::Fail() {
  Tell([this]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    failed_ = true;
    return false;
  });
}

JobLog::Tail JobLog::After(const Want& want, std::uint64_t* progress_seen,
                           std::shared_ptr<const Wake> waker) {
  const MutexLock lock(mutex_);
  Tail tail{Tail::Found::kEvents, want.position};
  if (IsBeforeRing(want.position)) {
    tail.found = Tail::Found::kOlder;
    return tail;
  }
  Collect(want, &tail);
  if (!tail.events.empty()) return tail;
  if (ended_ || failed_) {
    tail.found = ended_ ? Tail::Found::kEnd : Tail::Found::kFailed;
  } else if (progress_count_ > *progress_seen && want.position <= last_ &&
             (want.kinds & KindBit(v1::Event::kProgress))) {
    // Of a reader that knows more than this log the job may have ended.
    *progress_seen = progress_count_;
    tail.events.push_back(progress_);
  } else {
    tail.found = Tail::Found::kNothing;
    waiting_.insert(std::move(waker));
  }
  return tail;
}

bool JobLog::IsOlder(std::uint64_t position) const {
  const MutexLock lock(mutex_);
  return IsBeforeRing(position);
}

bool JobLog::IsBeforeRing(std::uint64_t position) const {
  return position < last_ && last_ - position > ring_.size();
}

void JobLog::Collect(const Want& want, Tail* tail) {
  std::size_t bytes = 0;
  const std::uint64_t before_ring = last_ - ring_.size();
  while (tail->position < last_ && bytes < want.max_bytes) {
    const LogRecord& next = ring_[tail->position - before_ring];
    ++tail->position;
    if (!(want.kinds & KindBit(next.kind))) continue;
    tail->events.push_back(next);
    bytes += next.event->size();
  }
}

void JobLog::Forget(const std::shared_ptr<const Wake>& waker) {
  const MutexLock lock(mutex_);
  waiting_.erase(waker);
}

}  // namespace contact
