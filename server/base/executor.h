#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <thread>

#include "base/mutex.h"

namespace contact {

/// A thread that runs tasks one after another, in the order in which they were posted. For what
/// must not block the caller, such as disk access.
class Executor {
 public:
  /// Runs on the executor's thread. Must not throw.
  using Task = std::function<void()>;

  /// Starts the thread. `name` is what the system shows of it: a literal of at most 15 letters.
  explicit Executor(const char* name = "executor");
  /// Stops, if Stop was not called.
  ~Executor();

  /// Queues a task. Returns at once. False once Stop was called: the task will not run.
  /// Thread-safe.
  bool Post(Task task);
  /// Waits until every posted task has run, and joins the thread. A second call does nothing. Not
  /// to be called by two threads at a time, nor by a task.
  void Stop();

 private:
  /// What the thread does.
  void Loop();

  Mutex mutex_;
  // Signals a task, or the stop.
  std::condition_variable_any posted_;
  // Posted and not begun, in order.
  std::deque<Task> tasks_ ABSL_GUARDED_BY(mutex_);
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;
  // The last member: it uses all of the above.
  std::thread thread_;
};

}  // namespace contact
