#include "rpc/net/flood_guard.h"

#include <spdlog/spdlog.h>

#include <utility>

namespace contact {
namespace {

// A client that keeps to the settings has 1000 streams; gRPC lets go of ended ones a little later.
constexpr int kMostOpen = 2000;
// In a second.
constexpr int kMostTakenBack = 1000;
// Connections that are remembered though they have no open call.
constexpr std::size_t kMostRemembered = 10'000;

}  // namespace

void FloodGuard::SetCut(Cut cut) {
  const MutexLock lock(mutex_);
  cut_ = std::move(cut);
}

FloodGuard::Lease FloodGuard::Enter(const std::string& uri) {
  const MutexLock lock(mutex_);
  if (++calls_[uri].open == kMostOpen + 1) End(uri, "has too many open calls");
  return {this, [self = shared_from_this(), uri](const void*) { self->Leave(uri); }};
}

void FloodGuard::TakenBack(const std::string& uri, Time now) {
  const MutexLock lock(mutex_);
  Calls& calls = calls_[uri];
  if (now - calls.since > std::chrono::seconds(1)) {
    calls.taken_back = 0;
    calls.since = now;
  }
  if (++calls.taken_back == kMostTakenBack + 1) End(uri, "takes back its calls");
}

void FloodGuard::End(const std::string& uri, const char* why) {
  if (uri.starts_with("unix") || !cut_) return;
  spdlog::warn("{} {}, and is cut", uri, why);
  cut_(uri);
}

void FloodGuard::Leave(const std::string& uri) {
  const MutexLock lock(mutex_);
  const auto found = calls_.find(uri);
  if (found == calls_.end() || --found->second.open > 0) return;
  if (found->second.taken_back == 0 || calls_.size() > kMostRemembered) calls_.erase(found);
}

}  // namespace contact
