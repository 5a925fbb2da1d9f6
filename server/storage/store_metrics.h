#pragma once

#include <atomic>
#include <cstdint>

#include "base/histogram.h"

namespace contact {

/// What the store has done since it was opened. Thread-safe.
struct StoreMetrics {
  Histogram commit_seconds{DecadeBounds(-4, 1)};    ///< Of one transaction, sync included.
  Histogram commit_operations{DecadeBounds(0, 3)};  ///< That shared it.
  std::atomic<std::int64_t> failed_commits = 0;
};

}  // namespace contact
