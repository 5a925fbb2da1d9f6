#include "rpc/metrics/rpc_metrics.h"

namespace contact {

void RpcMetrics::Began(const std::string& method) {
  const MutexLock lock(mutex_);
  ++methods_[method].open;
}

void RpcMetrics::Ended(const std::string& method, int code, double seconds) {
  const MutexLock lock(mutex_);
  Method& calls = methods_[method];
  --calls.open;
  ++calls.ended[code];
  calls.seconds->Count(seconds);
}

void RpcMetrics::Streamed(const std::string& method, std::int64_t bytes) {
  const MutexLock lock(mutex_);
  methods_[method].streamed_bytes += bytes;
}

void RpcMetrics::Refused(const std::string& reason, const std::string& resource) {
  const MutexLock lock(mutex_);
  ++refused_[reason];
  if (!resource.empty()) ++past_quota_[resource];
}

std::map<std::string, RpcMetrics::Method> RpcMetrics::methods() const {
  const MutexLock lock(mutex_);
  return methods_;
}

std::map<std::string, std::int64_t> RpcMetrics::refused() const {
  const MutexLock lock(mutex_);
  return refused_;
}

std::map<std::string, std::int64_t> RpcMetrics::past_quota() const {
  const MutexLock lock(mutex_);
  return past_quota_;
}

}  // namespace contact
