#include "gateway/call/open_requests.h"

namespace contact::gateway {

OpenRequests::Request OpenRequests::Begin() {
  const MutexLock lock(mutex_);
  if (finishing_) return nullptr;
  ++open_;
  return Request(this);
}

void OpenRequests::Finish(std::chrono::milliseconds grace) {
  const MutexLock lock(mutex_);
  finishing_ = true;
  ended_.wait_for(mutex_, grace,
                  [this]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) { return open_ == 0; });
}

void OpenRequests::Ended() {
  const MutexLock lock(mutex_);
  if (--open_ == 0) ended_.notify_all();
}

}  // namespace contact::gateway
