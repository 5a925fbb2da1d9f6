#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "base/mutex.h"
#include "jobs/run/run_control.h"

namespace contact {

/// A thread that works for one run after the other, and may be given up when it does not come back
/// from one. Thread-safe.
class Worker {
 public:
  /// Begins to work for a run.
  void Begin(std::shared_ptr<RunControl> run);
  /// Ends the work for a run. False: the worker was given up meanwhile; its thread must return
  /// without touching anything but its own variables, because the pool may be gone.
  bool End();

 private:
  friend class WorkerPool;

  /// Gives it up if it works for this run, which was given up.
  bool Abandon(const RunControl& run);
  /// Waits for its end, and takes the time that takes from `patience`. Once that is used up it
  /// gives the run up, as soon as the run is not held, and returns false.
  bool AwaitFinish(std::chrono::milliseconds* patience);
  /// Says that the loop has returned.
  void Finish();

  Mutex mutex_;
  /// Notified by Finish.
  std::condition_variable_any changed_;
  /// The run that it works for; null: none.
  std::shared_ptr<RunControl> run_ ABSL_GUARDED_BY(mutex_);
  /// True once it was given up.
  bool lost_ ABSL_GUARDED_BY(mutex_) = false;
  /// True once its loop has returned.
  bool finished_ ABSL_GUARDED_BY(mutex_) = false;
};

/// The workers. One that is given up is replaced; its thread may outlive the pool.
class WorkerPool {
 public:
  using Loop = std::function<void(Worker&)>;

  /// Each thread runs `loop` once.
  explicit WorkerPool(Loop loop) : loop_(std::move(loop)) {}

  /// Starts so many workers more.
  void Start(int threads);
  /// Gives up the workers of a run that was given up, and starts as many others. Returns how many.
  /// Thread-safe.
  int Replace(const RunControl& run);
  /// Waits until the loops have returned, and gives up those that take longer than `patience`.
  /// Not together with the other calls. Idempotent.
  void Stop(std::chrono::milliseconds patience);

 private:
  struct Member {
    std::shared_ptr<Worker> worker;
    std::thread thread;
  };

  const Loop loop_;
  Mutex mutex_;
  std::vector<Member> members_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace contact
