#pragma once

#include <atomic>
#include <memory>

namespace contact {

/// A limited number of places, such as those of watchers. Copies share their places. Thread-safe.
class Places {
 public:
  /// A taken place. It is free again once the last copy is destroyed, which may be after the
  /// Places themselves.
  using Place = std::shared_ptr<const void>;

  /// `count` places, all of them free.
  explicit Places(int count) : count_(count) {}

  /// Takes a place. Null if all are taken.
  Place Take() const {
    Place place(taken_.get(), [taken = taken_](const void*) { --*taken; });
    return ++*taken_ <= count_ ? place : nullptr;
  }

  /// Number of places, free and taken.
  int count() const { return count_; }

 private:
  const int count_;
  /// Places that are taken. Shared with them, so that they may outlive this.
  const std::shared_ptr<std::atomic<int>> taken_ = std::make_shared<std::atomic<int>>(0);
};

}  // namespace contact
