#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "base/clock.h"
#include "contact/v1/job_service.pb.h"
#include "jobs/log/log_cursor.h"

namespace contact {

/// A log as one watcher wants it delivered: leaves out frame chunks that come too fast for its
/// wishes, or for itself, and puts a gap in their place. Everything else passes as it is.
///
/// The newest chunk is held back until it is time, or something else must pass. What is held back
/// or not yet told by a gap is not counted into `position`, so a reader that resumes finds it
/// again.
class DeliveryCursor final : public LogCursor {
 public:
  /// How the watcher wants its frame chunks.
  struct Rules {
    /// Least time between two chunks.
    std::chrono::milliseconds min_frame_interval{0};
    /// What happens while the reader is behind.
    v1::DeliveryOptions::OverflowPolicy overflow = v1::DeliveryOptions::CONFLATE;
  };

  /// `behind` tells whether the reader of `cursor` is behind. The clock outlives this.
  DeliveryCursor(std::unique_ptr<LogCursor> cursor, std::function<bool()> behind,
                 const Clock& clock, Rules rules);

  Next Read(std::size_t max_bytes, std::vector<LogRecord>* out) override;
  std::uint64_t position() const override;
  std::uint64_t oldest() const override;

 private:
  /// Passes a record on, or holds it back if it is a chunk and none is `due`.
  void Pass(LogRecord record, bool due, std::vector<LogRecord>* out);
  /// Passes on what is held back.
  void Release(std::vector<LogRecord>* out);
  /// Moves what is held back into the gap.
  void LeaveOut();
  /// Passes the gap on, if it is not empty.
  void TellGap(std::vector<LogRecord>* out);

  const std::unique_ptr<LogCursor> cursor_;
  const std::function<bool()> behind_;
  const Clock& clock_;
  const Rules rules_;

  /// When a chunk was passed on last.
  std::optional<std::chrono::steady_clock::time_point> last_frame_;
  /// The newest chunk, if it is held back: several events if its columns are split.
  std::vector<LogRecord> held_;
  /// True if the next event has more columns of the newest chunk.
  bool columns_follow_ = false;
  /// True if the newest chunk is passed on.
  bool passing_ = false;
  /// The chunks left out before it; empty if there are none.
  v1::Gap gap_;
};

}  // namespace contact
