#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "contact/v1/event.pb.h"

namespace contact {

/// An event as it goes to watchers. All of them share its bytes.
struct LogRecord {
  /// Place in the log; 0: not part of it, as progress.
  std::uint64_t sequence = 0;
  v1::Event::PayloadCase kind = v1::Event::PAYLOAD_NOT_SET;
  /// A serialised v1::Event without sequence.
  std::shared_ptr<const std::string> event;
};

/// Serialises an event; its own sequence is left out.
LogRecord ToRecord(std::uint64_t sequence, v1::Event event);
/// Serialises events that have no sequence yet.
std::vector<LogRecord> ToRecords(std::vector<v1::Event> events);

/// A place in the log of one job, moving forward. Reads what is committed, from memory or the
/// store, so replay and live view are one path and a slow reader costs a number, not a queue.
///
/// Not thread-safe: one reader. Destroying it ends the watch.
class LogCursor {
 public:
  enum class Next {
    /// `out` holds at least one event.
    kEvents,
    /// Nothing now; `wake` will be called.
    kWait,
    /// The final state_changed event has been read.
    kEnd,
    /// The job was deleted.
    kDeleted,
    /// Frame chunks were asked for that have been dropped; see oldest().
    kCompacted,
    /// The reader fell behind, and wanted to be told.
    kSlow,
    /// The store could not read; watch again.
    kFailed,
  };

  virtual ~LogCursor() = default;

  /// Appends the next events to `out`, at least one and at most about `max_bytes`. Never blocks.
  virtual Next Read(std::size_t max_bytes, std::vector<LogRecord>* out) = 0;

  /// Sequence up to which everything asked for has been read: a safe point to resume from.
  virtual std::uint64_t position() const = 0;

  /// From this sequence on all events are there, as far as is known.
  virtual std::uint64_t oldest() const = 0;
};

}  // namespace contact
