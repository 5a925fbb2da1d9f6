#include "jobs/log/delivery_cursor.h"

#include <utility>

namespace contact {

DeliveryCursor::DeliveryCursor(std::unique_ptr<LogCursor> cursor, std::function<bool()> behind,
                               const Clock& clock, Rules rules)
    : cursor_(std::move(cursor)), behind_(std::move(behind)), clock_(clock), rules_(rules) {}

LogCursor::Next DeliveryCursor::Read(std::size_t max_bytes, std::vector<LogRecord>* out) {
  for (;;) {
    std::vector<LogRecord> records;
    const Next next = cursor_->Read(max_bytes, &records);
    const bool behind = behind_();
    if (behind && rules_.overflow == v1::DeliveryOptions::DISCONNECT) return Next::kSlow;
    const bool conflate = behind && rules_.overflow == v1::DeliveryOptions::CONFLATE;
    const auto due = [&] {
      return !conflate &&
             (!last_frame_ || clock_.Elapsed() - *last_frame_ >= rules_.min_frame_interval);
    };
    for (LogRecord& record : records) Pass(std::move(record), due(), out);
    if (next == Next::kWait && held_ && due()) Release(out);
    if (!out->empty()) return Next::kEvents;
    if (next != Next::kEvents) return next;
  }
}

std::uint64_t DeliveryCursor::oldest() const { return cursor_->oldest(); }

std::uint64_t DeliveryCursor::position() const {
  if (gap_.dropped_count() > 0) return gap_.first_sequence() - 1;
  return held_ ? held_->sequence - 1 : cursor_->position();
}

void DeliveryCursor::Pass(LogRecord record, bool due, std::vector<LogRecord>* out) {
  if (record.kind == v1::Event::kFrameChunk) {
    if (held_) LeaveOut();
    held_ = std::move(record);
    if (due) Release(out);
    return;
  }
  if (record.kind == v1::Event::kProgress) return out->push_back(std::move(record));
  // The last picture of a run is always shown.
  if (held_ && (due || record.kind == v1::Event::kStateChanged)) Release(out);
  if (held_) LeaveOut();
  TellGap(out);
  out->push_back(std::move(record));
}

void DeliveryCursor::Release(std::vector<LogRecord>* out) {
  TellGap(out);
  out->push_back(*std::exchange(held_, std::nullopt));
  last_frame_ = clock_.Elapsed();
}

void DeliveryCursor::LeaveOut() {
  const std::uint64_t sequence = std::exchange(held_, std::nullopt)->sequence;
  if (gap_.dropped_count() == 0) gap_.set_first_sequence(sequence);
  gap_.set_last_sequence(sequence);
  gap_.set_dropped_count(gap_.dropped_count() + 1);
}

void DeliveryCursor::TellGap(std::vector<LogRecord>* out) {
  if (gap_.dropped_count() == 0) return;
  const std::uint64_t last = gap_.last_sequence();
  v1::Event event;
  event.mutable_gap()->Swap(&gap_);
  gap_.Clear();
  out->push_back(ToRecord(last, std::move(event)));
}

}  // namespace contact
