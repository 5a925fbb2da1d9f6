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
  std::uint64_t sequence = 0;
  v1::Event::PayloadCase kind = v1::Event::PAYLOAD_NOT_SET;
  std::shared_ptr<const std::string> event;  ///< A serialised v1::Event without sequence.
};

/// Serialises an event; its own sequence is left out.
LogRecord ToRecord(std::uint64_t sequence, v1::Event event);
/// The same for events that have no sequence yet.
std::vector<LogRecord> ToRecords(std::vector<v1::Event> events);

/// A place in the log of one job, moving forward. Reads what is committed, from memory or the
/// store, so replay and live view are one path and a slow reader costs a number, not a queue.
///
/// Not thread-safe: one reader. Destroying it ends the watch.
class LogCursor {
 public:
  enum class Next {
    kEvents,     ///< `out` holds at least one event.
    kWait,       ///< Nothing now; `wake` will be called.
    kEnd,        ///< The final state_changed event has been read.
    kDeleted,    ///< The job was deleted.
    kCompacted,  ///< Frame chunks were asked for that have been dropped; see oldest().
    kSlow,       ///< The reader fell behind, and wanted to be told.
    kFailed,     ///< The store could not read; watch again.
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
