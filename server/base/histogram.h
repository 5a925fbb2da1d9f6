#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

namespace contact {

/// Counts values by the bucket that they fall into, without locks. Thread-safe; a snapshot may miss
/// values that are being counted meanwhile, so its sum and counts may not agree to the last value.
class Histogram {
 public:
  /// `bounds` are the largest values of the buckets, ascending. One more bucket takes what is
  /// beyond the last.
  explicit Histogram(std::vector<double> bounds);

  /// Counts a finite value. Does not block.
  void Count(double value);

  /// The counts at an instant.
  struct Snapshot {
    /// As given to the constructor.
    std::vector<double> bounds;
    /// Values in each bucket, not those below it; one more than bounds.
    std::vector<std::int64_t> counts;
    /// Of all values.
    double sum = 0;
  };
  /// What was counted so far.
  Snapshot Get() const;

 private:
  const std::vector<double> bounds_;
  std::vector<std::atomic<std::int64_t>> counts_;
  std::atomic<double> sum_ = 0;
};

/// Bounds that grow evenly on a logarithmic scale: 1, 2.5 and 5 times every power of ten from
/// 10^`first` on, up to 10^`last` itself. `first` ≤ `last`.
std::vector<double> DecadeBounds(int first, int last);

}  // namespace contact
