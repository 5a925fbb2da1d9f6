#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <stop_token>

#include "base/mutex.h"
#include "contact/v1/job.pb.h"
#include "jobs/job/budget.h"
#include "jobs/job/lifecycle.h"

namespace contact {

/// Why a run is asked to stop before its end.
enum class StopCause {
  /// The server ends. Every other cause replaces this one.
  kServer,
  /// CancelJob.
  kUser,
  /// The wall time of the budget is spent.
  kWallTime,
  /// The steps of the budget are spent.
  kSteps,
  /// The output bytes of the budget are spent.
  kOutput,
  /// The ledger takes its part of the memory of the budget.
  kMemory,
  /// The run made no step for too long.
  kStalled,
};

/// Connects one attempt of a job with those who watch over it: why it is to stop, whether another
/// is to have its worker, its signs of life, what it has used, and whether it was given up.
/// Thread-safe.
class RunControl {
 public:
  explicit RunControl(RunBudget budget = {}) : budget_(budget) {}

  /// Asks the run to stop. Of several causes the first counts, except for kServer.
  void Stop(StopCause cause = StopCause::kServer);
  /// Why the run is asked to stop. Only if `stopping()`.
  StopCause cause() const { return cause_; }
  bool stopping() const { return stop_.stop_requested(); }
  /// The token that the solver polls.
  std::stop_token token() const { return stop_.get_token(); }
  const RunBudget& budget() const { return budget_; }

  /// Asks the run to let another have its worker, as soon as it can.
  void AskToYield() { yielding_ = true; }
  bool yielding() const { return yielding_; }
  /// The run begins or ends to wait for its turn. The wait does not count as wall time.
  void SetWaiting(bool waiting) {
    waiting_ = waiting;
    yielding_ = false;
  }
  bool waiting() const { return waiting_; }

  /// Counts a step that begins. Stops the run if that is too many.
  void CountStep() { CountSteps(1); }
  /// Counts several steps, such as those of an earlier attempt.
  void CountSteps(std::int64_t steps);
  /// Counts bytes that are to be recorded. False: that is too many; the run is stopped.
  bool CountOutput(std::int64_t bytes);
  /// Counts memory that the ledger takes. Stops the run if that is more than a quarter of the
  /// budget: at the end of the run there are copies of it for the result and for the store.
  void CountLedger(std::int64_t bytes);
  /// A number that changes while the run makes progress.
  std::int64_t signs() const { return steps_ + output_bytes_; }

  /// Keeps the run from being given up, for a scope in which it hands something to the rest of the
  /// server and may wait for the disk. False: the run was given up before, and must not hand over
  /// anything.
  class Hold {
   public:
    explicit Hold(RunControl& run);
    ~Hold();
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;
    explicit operator bool() const { return held_; }

   private:
    RunControl& run_;
    const bool held_;
  };
  /// True while a Hold exists.
  bool held() const;

  /// Gives the run up, for ever. False: it is held just now.
  bool GiveUp();

 private:
  /// Begins a hold. False: the run was given up.
  bool Enter();

  const RunBudget budget_;
  std::stop_source stop_;
  std::atomic<StopCause> cause_ = StopCause::kServer;
  std::atomic<bool> yielding_ = false;
  std::atomic<bool> waiting_ = false;
  std::atomic<std::int64_t> steps_ = 0;
  std::atomic<std::int64_t> output_bytes_ = 0;
  std::atomic<std::int64_t> ledger_bytes_ = 0;

  mutable Mutex mutex_;
  /// Number of holds.
  int holds_ ABSL_GUARDED_BY(mutex_) = 0;
  bool given_up_ ABSL_GUARDED_BY(mutex_) = false;
};

/// The transition of a job whose run was stopped for this cause, which is not kServer.
Transition TransitionAfterStop(StopCause cause, const RunBudget& budget);

}  // namespace contact
