#include "rpc/net/flood_guard.h"

#include <malloc.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "base/resident_memory.h"

namespace contact {
namespace {

// A client that keeps to the settings has 1000 streams; gRPC lets go of ended ones a little later.
constexpr int kMostOpen = 2000;
// In a second.
constexpr int kMostTakenBack = 1000;
// Bytes that a connection may send between two answers. gRPC tells of a call when its message is
// there, and reads one that is too large to its end.
constexpr std::uint64_t kMostUnanswered = 64 << 20;
// Bytes sent to it for which it may send one more: a stream has windows, but no answer.
constexpr std::uint64_t kSentPerByte = 64;
// Least time between two trims of memory, for each makes others wait.
constexpr std::chrono::milliseconds kTrimTime{50};
// gRPC lets go of a connection that was cut, and of all it kept for it, within this time.
constexpr std::chrono::milliseconds kCutTime{1000};
// Growth of the process [B] that is a reason to trim: gRPC itself cuts who floods it with pings.
constexpr std::int64_t kGrowth = 128 << 20;

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

bool FloodGuard::Floods(const Traffic& then, const Traffic& now) {
  return now.received - then.received > kMostUnanswered + (now.sent - then.sent) / kSentPerByte;
}

void FloodGuard::Look(const std::vector<Traffic>& all, Time now) {
  // What a flood took is free by now, but lies between what others use.
  if (IsTimeToTrim(now)) malloc_trim(0);
  const MutexLock lock(mutex_);
  for (const Traffic& traffic : all) {
    Calls& calls = calls_[traffic.uri];
    calls.there = true;
    if (std::exchange(calls.answered, false)) {
      calls.then = traffic;
    } else if (calls.then.uri.empty() || traffic.received < calls.then.received) {
      calls.then = {.uri = traffic.uri};  // Another connection than before, if there was one.
    } else if (Floods(calls.then, traffic)) {
      End(traffic.uri, "sends far more than its calls need");
      calls.then = traffic;
    }
  }
  std::erase_if(calls_,
                [](const auto& entry) { return !entry.second.there && entry.second.open == 0; });
  for (auto& [uri, calls] : calls_) calls.there = false;
}

void FloodGuard::End(const std::string& uri, const char* why) {
  if (uri.starts_with("unix") || !cut_) return;
  spdlog::warn("{} {}, and is cut", uri, why);
  cut_(uri);
  some_cut_ = true;
}

bool FloodGuard::IsTimeToTrim(Time now) {
  const std::int64_t resident = ResidentMemory();
  const MutexLock lock(mutex_);
  least_ = std::min(least_, resident);
  if (std::exchange(some_cut_, false)) cut_ends_ = now + kCutTime;
  const auto wait = now < cut_ends_ ? kTrimTime : kCutTime;
  if (now - trimmed_ < wait || (now >= cut_ends_ && resident - least_ < kGrowth)) return false;
  trimmed_ = now;
  least_ = resident;
  return true;
}

void FloodGuard::Leave(const std::string& uri) {
  const MutexLock lock(mutex_);
  --calls_[uri].open;
}

}  // namespace contact
