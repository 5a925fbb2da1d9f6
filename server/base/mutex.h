#pragma once

#include <absl/base/thread_annotations.h>

#include <mutex>

namespace contact {

/// std::mutex that clang's thread-safety analysis knows. Not absl::Mutex: Debian's is built
/// without ThreadSanitizer's marks, so every use of it would be reported as a race.
///
/// Waits go through std::condition_variable_any, which takes the Mutex itself.
class ABSL_LOCKABLE Mutex {
 public:
  /// Waits until no other thread holds it. Not recursive.
  void lock() ABSL_EXCLUSIVE_LOCK_FUNCTION() { mutex_.lock(); }
  /// False if another thread holds it. Does not wait.
  bool try_lock() ABSL_EXCLUSIVE_TRYLOCK_FUNCTION(true) { return mutex_.try_lock(); }
  void unlock() ABSL_UNLOCK_FUNCTION() { mutex_.unlock(); }

 private:
  std::mutex mutex_;
};

/// Holds a Mutex from its construction to its destruction.
class ABSL_SCOPED_LOCKABLE MutexLock {
 public:
  explicit MutexLock(Mutex& mutex) ABSL_EXCLUSIVE_LOCK_FUNCTION(mutex) : mutex_(mutex) {
    mutex_.lock();
  }
  ~MutexLock() ABSL_UNLOCK_FUNCTION() { mutex_.unlock(); }
  MutexLock(const MutexLock&) = delete;
  MutexLock& operator=(const MutexLock&) = delete;

 private:
  Mutex& mutex_;
};

}  // namespace contact
