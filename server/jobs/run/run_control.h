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
enum class StopCause { kServer, kUser, kWallTime, kSteps, kOutput, kStalled };

/// What there is between one attempt of a job and those who watch over it: why it is to stop, its
/// signs of life, what it has used, and whether it is still listened to. Thread-safe.
class RunControl {
 public:
  explicit RunControl(RunBudget budget = {}) : budget_(budget) {}

  /// Asks the run to stop. Of several causes the first counts; kServer, that it is about to end,
  /// the least.
  void Stop(StopCause cause = StopCause::kServer);
  StopCause cause() const { return cause_; }
  bool stopping() const { return stop_.stop_requested(); }
  std::stop_token token() const { return stop_.get_token(); }
  const RunBudget& budget() const { return budget_; }

  /// One more step begins, or so many that an earlier attempt has made count too. Stops the run if
  /// that is too many.
  void CountStep() { CountSteps(1); }
  void CountSteps(std::int64_t steps);
  /// So many bytes are to be recorded. False: that is too many; the run is stopped.
  bool CountOutput(std::int64_t bytes);
  /// A number that changes while the run makes progress.
  std::int64_t signs() const { return steps_ + output_bytes_; }

  /// For a scope in which the run reports to the rest of the server, and may wait for the disk.
  /// False: the run was given up, and nobody wants to hear of it any more.
  class Report {
   public:
    explicit Report(RunControl& control) : control_(control), heard_(control.Enter()) {}
    ~Report() {
      if (heard_) control_.Leave();
    }
    Report(const Report&) = delete;
    Report& operator=(const Report&) = delete;
    explicit operator bool() const { return heard_; }

   private:
    RunControl& control_;
    const bool heard_;
  };
  /// True while someone reports.
  bool reporting() const;

  /// Stops to listen to the run, for ever. False: it reports just now.
  bool GiveUp();
  bool given_up() const;

 private:
  bool Enter();
  void Leave();

  const RunBudget budget_;
  std::stop_source stop_;
  std::atomic<StopCause> cause_ = StopCause::kServer;
  std::atomic<std::int64_t> steps_ = 0;
  std::atomic<std::int64_t> output_bytes_ = 0;

  mutable Mutex mutex_;
  int reports_ ABSL_GUARDED_BY(mutex_) = 0;
  bool given_up_ ABSL_GUARDED_BY(mutex_) = false;
};

/// The transition of a job whose run was stopped for this cause, which is not kServer.
Transition TransitionAfterStop(StopCause cause, const RunBudget& budget);

}  // namespace contact
