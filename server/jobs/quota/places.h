#pragma once

#include <algorithm>
#include <atomic>
#include <memory>

#include "identity/principal.h"

namespace contact {

/// How many of `count` places the principal may take: `kept` of them, but no more than half, are
/// for admins.
inline int OpenTo(const Principal& caller, int count, int kept) {
  return May(caller, Permission::kAdmin) ? count : count - std::min(kept, count / 2);
}

/// A limited number of places, such as those of watchers. Copies share their places. Thread-safe.
class Places {
 public:
  /// A taken place. It is free again once the last copy is destroyed, which may be after the
  /// Places themselves.
  using Place = std::shared_ptr<const void>;

  /// `count` places, all of them free; `kept`: see OpenTo.
  explicit Places(int count, int kept = 0) : count_(count), kept_(kept) {}

  /// Takes a place, whoever it is for. Null if all are taken.
  Place Take() const { return TakeOf(count_); }
  /// Takes a place for the caller. Null if all that are open to it are taken.
  Place Take(const Principal& caller) const { return TakeOf(open(caller)); }

  /// Number of places that are open to the caller, free and taken.
  int open(const Principal& caller) const { return OpenTo(caller, count_, kept_); }
  /// Number of places that are taken.
  int taken() const { return *taken_; }

 private:
  Place TakeOf(int most) const {
    Place place(taken_.get(), [taken = taken_](const void*) { --*taken; });
    return ++*taken_ <= most ? place : nullptr;
  }

  const int count_;
  const int kept_;
  /// Places that are taken. Shared with them, so that they may outlive this.
  const std::shared_ptr<std::atomic<int>> taken_ = std::make_shared<std::atomic<int>>(0);
};

}  // namespace contact
