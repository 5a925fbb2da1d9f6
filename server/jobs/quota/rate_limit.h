#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <string>

#include "base/mutex.h"

namespace contact {

/// Limits how often each peer may do something: a token bucket for each. Thread-safe.
class RateLimit {
 public:
  /// Of one monotonic clock.
  using Time = std::chrono::steady_clock::time_point;

  /// A bucket gains `per_second` tokens and holds at most `burst` (>= 1). `per_second` 0: no limit.
  RateLimit(double per_second, int burst) : per_second_(per_second), burst_(burst) {}

  /// Takes a token of the peer and returns 0; without a token, returns how long it takes until
  /// there is one, rounded up.
  std::chrono::milliseconds Take(const std::string& peer, Time now);

  /// Tokens that the peer has taken and that have not come back.
  double TakenBy(const std::string& peer, Time now) const;

  /// Number of buckets that are kept. Full ones are forgotten now and then.
  std::size_t peers() const;

 private:
  struct Bucket {
    /// Tokens at the time `at`.
    double tokens;
    /// When the peer took a token last.
    Time at;
  };
  /// Tokens of the bucket at `now`, at most burst_.
  double TokensAt(const Bucket& bucket, Time now) const;
  /// Forgets the buckets that are full at `now`.
  void ForgetFull(Time now) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  /// Tokens that a bucket gains in a second; 0: no limit.
  const double per_second_;
  /// Tokens in a full bucket.
  const int burst_;
  mutable Mutex mutex_;
  /// By peer. A missing bucket is full.
  std::map<std::string, Bucket> buckets_ ABSL_GUARDED_BY(mutex_);
  /// Number of buckets at which ForgetFull is called next.
  std::size_t forget_at_ ABSL_GUARDED_BY(mutex_) = 1024;
};

}  // namespace contact
