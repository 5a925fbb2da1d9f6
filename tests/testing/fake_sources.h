#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>

#include "base/clock.h"
#include "base/ids.h"

namespace contact {

/// A clock that stands still until it is moved. Thread-safe.
class FakeClock final : public Clock {
 public:
  /// Every reading of Elapsed moves it on by `tick`: for code that waits until time has passed.
  explicit FakeClock(std::chrono::milliseconds tick = {}) : tick_(tick) {}

  std::chrono::system_clock::time_point Now() const override { return now_; }
  std::chrono::steady_clock::time_point Elapsed() const override {
    ++readings_;
    readings_.notify_all();
    return Time(std::chrono::milliseconds(elapsed_ms_.fetch_add(tick_.count())));
  }
  /// Waits until Elapsed has been read so many times from now on.
  void AwaitReadings(int count) const {
    const int goal = readings_ + count;
    for (int seen = readings_; seen < goal; seen = readings_) readings_.wait(seen);
  }
  void Advance(std::chrono::milliseconds by) {
    Jump(by);
    elapsed_ms_ += by.count();
  }
  /// What an administrator may do to the clock.
  void Jump(std::chrono::milliseconds by) { now_ = now_.load() + by; }

 private:
  using Time = std::chrono::steady_clock::time_point;

  const std::chrono::milliseconds tick_;
  std::atomic<std::chrono::system_clock::time_point> now_ =
      std::chrono::system_clock::time_point(std::chrono::seconds(1'000'000));
  mutable std::atomic<std::int64_t> elapsed_ms_ = 0;
  mutable std::atomic<int> readings_ = 0;
};

/// a1, a2, a3 …; uid-1, uid-2 …
class CountingIds final : public IdSource {
 public:
  explicit CountingIds(std::string prefix = "a") : prefix_(std::move(prefix)) {}
  std::string NextId() override { return prefix_ + std::to_string(++count_); }
  /// From here on the names come once more.
  void StartNamesAnew() { count_ = 0; }
  std::string NextUuid() override { return "uid-" + std::to_string(++uids_); }

 private:
  const std::string prefix_;
  std::atomic<int> count_ = 0;
  std::atomic<int> uids_ = 0;
};

}  // namespace contact
