#pragma once

#include <atomic>
#include <chrono>
#include <string>

#include "jobs/sources.h"

namespace contact {

/// A clock that stands still until it is moved.
class FakeClock final : public Clock {
 public:
  std::chrono::system_clock::time_point Now() const override { return now_; }
  void Advance(std::chrono::seconds by) { now_ = now_.load() + by; }

 private:
  std::atomic<std::chrono::system_clock::time_point> now_ =
      std::chrono::system_clock::time_point(std::chrono::seconds(1'000'000));
};

/// a1, a2, a3 …
class CountingIds final : public IdSource {
 public:
  explicit CountingIds(std::string prefix = "a") : prefix_(std::move(prefix)) {}
  std::string NextJobId() override { return prefix_ + std::to_string(++count_); }

 private:
  const std::string prefix_;
  std::atomic<int> count_ = 0;
};

}  // namespace contact
