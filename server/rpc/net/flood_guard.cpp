#include "rpc/net/flood_guard.h"

#include <spdlog/spdlog.h>

#include <utility>

namespace contact {
namespace {

// A client that keeps to the settings has 1000 streams; gRPC lets go of ended ones a little later.
constexpr int kMostOpen = 2000;
// In a second.
constexpr int kMostTakenBack = 1000;
// Bytes that a connection may send between two answers: frames that belong to no call, as many as
// windows for what it was sent need, and some for as long as a stream lasts.
constexpr std::uint64_t kMostSilent = 1 << 20;
constexpr std::uint64_t kSentPerByte = 64;
constexpr std::uint64_t kSilentPerSecond = 16 << 10;
// More while the message of a call comes: also for one that is too large, which is read to its end.
constexpr std::uint64_t kMostMessage = 128 << 20;

}  // namespace

void FloodGuard::SetCut(Cut cut) {
  const MutexLock lock(mutex_);
  cut_ = std::move(cut);
}

FloodGuard::Lease FloodGuard::Enter(const std::string& uri) {
  const MutexLock lock(mutex_);
  Calls& calls = calls_[uri];
  ++calls.unasked;
  if (++calls.open == kMostOpen + 1) End(uri, "has too many open calls");
  return {this, [self = shared_from_this(), uri](const void*) { self->Leave(uri); }};
}

void FloodGuard::Asked(const std::string& uri) {
  const MutexLock lock(mutex_);
  --calls_[uri].unasked;
}

void FloodGuard::Answered(const std::string& uri) {
  const MutexLock lock(mutex_);
  calls_[uri].answered = true;
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

bool FloodGuard::Floods(const Calls& calls, const Traffic& traffic, Time now) {
  const std::uint64_t received = traffic.received - calls.then.received;
  const std::chrono::duration<double> time = now - calls.then_time;
  const std::uint64_t windows = (traffic.sent - calls.then.sent) / kSentPerByte;
  const auto steady = static_cast<std::uint64_t>(time.count() * kSilentPerSecond);
  return received > kMostSilent + windows + steady + (calls.unasked > 0 ? kMostMessage : 0);
}

void FloodGuard::Look(const std::vector<Traffic>& all, Time now) {
  const MutexLock lock(mutex_);
  for (const Traffic& traffic : all) {
    Calls& calls = calls_[traffic.uri];
    calls.there = true;
    // A first look, or one at a new connection from the same port.
    const bool another = calls.then.uri.empty() || traffic.received < calls.then.received;
    const bool floods = !another && !calls.answered && Floods(calls, traffic, now);
    if (floods) End(traffic.uri, "sends far more than its calls need");
    if (!another && !floods && !calls.answered) continue;
    calls.answered = false;
    calls.then = another ? Traffic{.uri = traffic.uri} : traffic;
    calls.then_time = now;
  }
  std::erase_if(calls_,
                [](const auto& entry) { return !entry.second.there && entry.second.open == 0; });
  for (auto& [uri, calls] : calls_) calls.there = false;
}

void FloodGuard::End(const std::string& uri, const char* why) {
  if (uri.starts_with("unix") || !cut_) return;
  spdlog::warn("{} {}, and is cut", uri, why);
  cut_(uri);
}

void FloodGuard::Leave(const std::string& uri) {
  const MutexLock lock(mutex_);
  --calls_[uri].open;
}

}  // namespace contact
