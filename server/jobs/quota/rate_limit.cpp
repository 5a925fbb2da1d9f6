#include "jobs/quota/rate_limit.h"

#include <algorithm>
#include <cmath>

namespace contact {

std::chrono::milliseconds RateLimit::Take(const std::string& peer, Time now) {
  if (per_second_ == 0) return std::chrono::milliseconds(0);
  const MutexLock lock(mutex_);
  if (buckets_.size() >= forget_at_) ForgetFull(now);
  Bucket& bucket = buckets_.try_emplace(peer, Bucket{double(burst_), now}).first->second;
  bucket = {TokensAt(bucket, now), now};
  if (bucket.tokens < 1) {
    const double seconds = (1 - bucket.tokens) / per_second_;
    return std::chrono::milliseconds(static_cast<std::int64_t>(std::ceil(seconds * 1000)));
  }
  --bucket.tokens;
  return std::chrono::milliseconds(0);
}

double RateLimit::TakenBy(const std::string& peer, Time now) const {
  const MutexLock lock(mutex_);
  const auto bucket = buckets_.find(peer);
  return bucket == buckets_.end() ? 0 : burst_ - TokensAt(bucket->second, now);
}

std::size_t RateLimit::peers() const {
  const MutexLock lock(mutex_);
  return buckets_.size();
}

double RateLimit::TokensAt(const Bucket& bucket, Time now) const {
  const std::chrono::duration<double> since = now - bucket.at;
  return std::min<double>(burst_, bucket.tokens + std::max(0.0, since.count()) * per_second_);
}

// Forgets idle peers. Doubling the threshold makes the cost of a search constant for each call.
void RateLimit::ForgetFull(Time now) {
  std::erase_if(buckets_, [&](const auto& entry) { return TokensAt(entry.second, now) >= burst_; });
  forget_at_ = std::max<std::size_t>(1024, 2 * buckets_.size());
}

}  // namespace contact
