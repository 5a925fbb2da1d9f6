#pragma once

#include <cstddef>
#include <functional>
#include <set>

#include "base/mutex.h"

namespace contact::gateway {

/// Counts the bytes that connections hold in the process: of requests that are not yet answered,
/// and of answers that are not yet sent. Past the most in sum the connection that holds most is
/// cut. Thread-safe.
class HeldBytes {
 public:
  /// What one connection holds, until it goes.
  class Account {
   public:
    /// `cut` ends the connection. Any thread may call it, once, and it must not wait nor use the
    /// account.
    Account(HeldBytes& all, std::function<void()> cut);
    ~Account();
    Account(const Account&) = delete;
    Account& operator=(const Account&) = delete;

    void Add(std::size_t bytes);
    /// Takes back so much of what was added.
    void Sub(std::size_t bytes);

   private:
    friend HeldBytes;
    HeldBytes& all_;
    /// Empty once it was called: the connection is going, and counts no more. Guarded, as bytes_,
    /// by the mutex of all_.
    std::function<void()> cut_;
    std::size_t bytes_ = 0;
  };

  /// `most` in bytes.
  explicit HeldBytes(std::size_t most) : most_(most) {}

  /// The bytes that are held now.
  std::size_t bytes() const;

 private:
  void CutHeaviest() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const std::size_t most_;
  mutable Mutex mutex_;
  std::size_t bytes_ ABSL_GUARDED_BY(mutex_) = 0;
  std::set<Account*> accounts_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace contact::gateway
