#pragma once

#include <atomic>
#include <cstdint>

#include "base/histogram.h"

namespace contact {

/// Counters of a server's streams. Thread-safe.
struct StreamMetrics {
  /// Streams whose reader holds up a write; see Stream.
  std::atomic<std::int64_t> slow = 0;
  /// Streams whose reader took nothing for too long.
  std::atomic<std::int64_t> dropped = 0;
  /// Events left out and replaced by gaps.
  std::atomic<std::int64_t> conflated = 0;
  /// Time from an event that a stream reacts to until its next operation is started, in seconds.
  /// gRPC has few threads for all reactions, so all of them must be short.
  Histogram reaction_seconds{DecadeBounds(-6, 0)};
};

}  // namespace contact
