#pragma once

#include <atomic>
#include <cstdint>

#include "base/histogram.h"

namespace contact {

/// What the store has done since it was opened. Thread-safe.
struct StoreMetrics {
  /// Durations of the transactions [s], sync included.
  Histogram commit_seconds{DecadeBounds(-4, 1)};
  /// Operations that shared a transaction.
  Histogram commit_operations{DecadeBounds(0, 3)};
  /// Transactions that were rolled back.
  std::atomic<std::int64_t> failed_commits = 0;
};

}  // namespace contact
