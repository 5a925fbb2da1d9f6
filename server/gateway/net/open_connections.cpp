#include "gateway/net/open_connections.h"

#include <utility>

namespace contact::gateway {

OpenConnections::Lease OpenConnections::Enter(const std::string& peer) {
  const MutexLock lock(mutex_);
  if (open_ >= static_cast<std::size_t>(limits_.in_all) || peers_->Of(peer) >= limits_.per_peer) {
    ++refused_;
    return nullptr;
  }
  ++open_;
  return {this, [self = shared_from_this(), place = peers_->Enter(peer)](const void*) mutable {
            place.reset();
            self->Left();
          }};
}

OpenConnections::Lease OpenConnections::Register(Tell tell) {
  const MutexLock lock(mutex_);
  if (draining_) tell(cut_);
  const auto place = told_.insert(told_.end(), std::move(tell));
  return {this, [self = shared_from_this(), place](const void*) {
            const MutexLock held(self->mutex_);
            self->told_.erase(place);
          }};
}

void OpenConnections::TellAll(bool cut) {
  const MutexLock lock(mutex_);
  draining_ = true;
  cut_ = cut;
  for (const Tell& tell : told_) tell(cut);
}

std::size_t OpenConnections::open() const {
  const MutexLock lock(mutex_);
  return open_;
}

std::int64_t OpenConnections::refused() const {
  const MutexLock lock(mutex_);
  return refused_;
}

void OpenConnections::AwaitNone() {
  const MutexLock lock(mutex_);
  left_.wait(mutex_, [this]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) { return open_ == 0; });
}

void OpenConnections::Left() {
  const MutexLock lock(mutex_);
  if (--open_ == 0) left_.notify_all();
}

}  // namespace contact::gateway
