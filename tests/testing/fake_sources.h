#pragma once

#include <atomic>
#include <chrono>
#include <string>

#include "base/clock.h"
#include "base/ids.h"

namespace contact {

/// Clocks that stand still until they are moved.
class FakeClock final : public Clock {
 public:
  std::chrono::system_clock::time_point Now() const override { return now_; }
  std::chrono::steady_clock::time_point Elapsed() const override { return elapsed_; }
  void Advance(std::chrono::milliseconds by) {
    Jump(by);
    elapsed_ = elapsed_.load() + by;
  }
  /// What an administrator may do to the clock.
  void Jump(std::chrono::milliseconds by) { now_ = now_.load() + by; }

 private:
  std::atomic<std::chrono::system_clock::time_point> now_ =
      std::chrono::system_clock::time_point(std::chrono::seconds(1'000'000));
  std::atomic<std::chrono::steady_clock::time_point> elapsed_ = {};
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
