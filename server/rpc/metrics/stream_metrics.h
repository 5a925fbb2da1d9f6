#pragma once

#include <atomic>
#include <cstdint>

#include "base/histogram.h"

namespace contact {

/// What the streams of a server have come to. Thread-safe.
struct StreamMetrics {
  std::atomic<std::int64_t> slow = 0;     ///< Streams whose reader now holds up a write; see Tick.
  std::atomic<std::int64_t> dropped = 0;  ///< Streams whose reader took nothing for too long.
  std::atomic<std::int64_t> conflated = 0;  ///< Events left out for readers that were told so.
  /// From what a stream reacts to until its next operation is started. gRPC has few threads for
  /// all reactions, so all of them should be short.
  Histogram reaction_seconds{DecadeBounds(-6, 0)};
};

}  // namespace contact
