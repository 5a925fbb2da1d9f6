#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "contact/v1/job_service.pb.h"
#include "jobs/log/log_cursor.h"
#include "jobs/log/tail_cursor.h"

namespace contact {

/// A log as one watcher wants it delivered: leaves out frame chunks that come too fast for its
/// wishes, or for itself, and puts a gap in their place. Everything else passes as it is.
///
/// The newest chunk is held back until it is time, or something else must pass. What is held back
/// or not yet told by a gap is not counted into `position`, so a reader that resumes finds it
/// again.
class DeliveryCursor final : public LogCursor {
 public:
  using Clock = std::chrono::steady_clock;
  struct Rules {
    std::chrono::milliseconds min_frame_interval{0};
    v1::DeliveryOptions::OverflowPolicy overflow = v1::DeliveryOptions::CONFLATE;
  };

  /// `cursor`, and whether its reader is behind.
  DeliveryCursor(std::unique_ptr<LogCursor> cursor, std::function<bool()> behind, Rules rules,
                 std::function<Clock::time_point()> now = Clock::now);

  Next Read(std::size_t max_bytes, std::vector<LogRecord>* out) override;
  std::uint64_t position() const override;
  std::uint64_t oldest() const override;

 private:
  void Pass(LogRecord record, bool due, std::vector<LogRecord>* out);
  void Release(std::vector<LogRecord>* out);
  void LeaveOut();
  void TellGap(std::vector<LogRecord>* out);

  const std::unique_ptr<LogCursor> cursor_;
  const std::function<bool()> behind_;
  const Rules rules_;
  const std::function<Clock::time_point()> now_;

  std::optional<Clock::time_point> last_frame_;  ///< When one was passed on.
  std::optional<LogRecord> held_;                ///< The newest chunk, not passed on.
  v1::Gap gap_;                                  ///< Left out before it; empty if none.
};

}  // namespace contact
