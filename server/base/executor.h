#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <thread>

#include "base/mutex.h"

namespace contact {

/// One thread that does what may take a while, in the order in which it was asked.
class Executor {
 public:
  using Task = std::function<void()>;

  /// The thread gets this name, of at most 15 letters.
  explicit Executor(const char* name = "executor");
  ~Executor();

  /// False once stopped: the task will not run. Thread-safe.
  bool Post(Task task);
  /// Runs what was posted, then joins. Idempotent; by one thread.
  void Stop();

 private:
  void Loop();

  Mutex mutex_;
  std::condition_variable_any posted_;
  std::deque<Task> tasks_ ABSL_GUARDED_BY(mutex_);
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;
  std::thread thread_;  // Last: it uses all of the above.
};

}  // namespace contact
