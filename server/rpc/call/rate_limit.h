#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <string>

#include "base/mutex.h"

namespace contact {

/// Lets each peer do something so often on average, and so many times at once: a bucket of tokens
/// for each. Thread-safe.
class RateLimit {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// `per_second` 0: any number. `burst` ≥ 1.
  RateLimit(double per_second, int burst) : per_second_(per_second), burst_(burst) {}

  /// Takes a token of the peer and returns 0; or, if there is none, how long until there is.
  std::chrono::milliseconds Take(const std::string& peer, Time now);

  /// Peers whose bucket is not full, as of some calls before.
  std::size_t peers() const;

 private:
  struct Bucket {
    double tokens;
    Time at;
  };
  double TokensAt(const Bucket& bucket, Time now) const;
  void ForgetFull(Time now) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const double per_second_;
  const int burst_;
  mutable Mutex mutex_;
  std::map<std::string, Bucket> buckets_ ABSL_GUARDED_BY(mutex_);  ///< None: it is full.
  std::size_t forget_at_ ABSL_GUARDED_BY(mutex_) = 1024;
};

}  // namespace contact
