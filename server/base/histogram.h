#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

namespace contact {

/// Counts values by the bucket they fall into. Thread-safe; a snapshot may miss what is being
/// counted meanwhile.
class Histogram {
 public:
  /// `bounds`: what the buckets hold at most, ascending; one more takes what is beyond.
  explicit Histogram(std::vector<double> bounds);

  void Count(double value);

  struct Snapshot {
    std::vector<double> bounds;
    std::vector<std::int64_t> counts;  ///< One more than bounds.
    double sum = 0;
  };
  Snapshot Get() const;

 private:
  const std::vector<double> bounds_;
  std::vector<std::atomic<std::int64_t>> counts_;
  std::atomic<double> sum_ = 0;
};

/// 1, 2.5 and 5 of every power of ten from 10^`first` to 10^`last`.
std::vector<double> DecadeBounds(int first, int last);

}  // namespace contact
