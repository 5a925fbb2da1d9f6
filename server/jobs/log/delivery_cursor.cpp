#include "jobs/log/delivery_cursor.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/wire_format_lite.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>

namespace contact {
namespace {

using google::protobuf::internal::WireFormatLite;

constexpr std::uint32_t kChunkTag = WireFormatLite::MakeTag(
    v1::Event::kFrameChunkFieldNumber, WireFormatLite::WIRETYPE_LENGTH_DELIMITED);
constexpr std::uint32_t kFollowTag = WireFormatLite::MakeTag(
    v1::FrameChunk::kColumnsFollowFieldNumber, WireFormatLite::WIRETYPE_VARINT);

// True if the next event has more columns of this frame chunk. Parsing it would take far longer
// than looking for the one field.
bool ColumnsFollow(const LogRecord& record) {
  google::protobuf::io::CodedInputStream in(
      reinterpret_cast<const std::uint8_t*>(record.event->data()),
      static_cast<int>(record.event->size()));
  bool inside = false;
  while (const std::uint32_t tag = in.ReadTag()) {
    std::uint32_t value = 0;
    if (inside && tag == kFollowTag) return in.ReadVarint32(&value) && value != 0;
    if (!inside && tag == kChunkTag) {
      inside = in.ReadVarint32(&value);
    } else if (!WireFormatLite::SkipField(&in, tag)) {
      return false;
    }
  }
  return false;
}

}  // namespace

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
    if (next == Next::kWait && !held_.empty() && due()) Release(out);
    if (!out->empty()) return Next::kEvents;
    if (next != Next::kEvents) return next;
  }
}

std::uint64_t DeliveryCursor::oldest() const { return cursor_->oldest(); }

std::uint64_t DeliveryCursor::position() const {
  if (gap_.dropped_count() > 0) return gap_.first_sequence() - 1;
  return held_.empty() ? cursor_->position() : held_.front().sequence - 1;
}

void DeliveryCursor::Pass(LogRecord record, bool due, std::vector<LogRecord>* out) {
  if (record.kind == v1::Event::kFrameChunk) {
    if (!std::exchange(columns_follow_, ColumnsFollow(record))) {
      LeaveOut();
      passing_ = due;
    }
    held_.push_back(std::move(record));
    if (passing_) Release(out);
    return;
  }
  if (record.kind == v1::Event::kProgress) return out->push_back(std::move(record));
  // The last picture of a run is always shown.
  if (!held_.empty() && (due || record.kind == v1::Event::kStateChanged)) Release(out);
  LeaveOut();
  TellGap(out);
  out->push_back(std::move(record));
}

void DeliveryCursor::Release(std::vector<LogRecord>* out) {
  TellGap(out);
  std::ranges::move(std::exchange(held_, {}), std::back_inserter(*out));
  passing_ = true;
  last_frame_ = clock_.Elapsed();
}

void DeliveryCursor::LeaveOut() {
  for (const LogRecord& record : std::exchange(held_, {})) {
    if (gap_.dropped_count() == 0) gap_.set_first_sequence(record.sequence);
    gap_.set_last_sequence(record.sequence);
    gap_.set_dropped_count(gap_.dropped_count() + 1);
  }
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
