#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "base/mutex.h"
#include "jobs/job/job_options.h"
#include "jobs/run/sweep_run.h"
#include "jobs/schedule/scheduler.h"
#include "storage/shared_store.h"

namespace contact {

/// Has idle workers of this process compute cells of sweeps that run elsewhere: one loan after the
/// other.
class SweepBorrower {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// `worker`: WorkerProcess::name. `wake` is called when there is something to Look at. All
  /// outlive it and what it has asked for.
  SweepBorrower(SharedStore& store, const Clock& clock, const JobOptions& options,
                std::string worker, Scheduler& scheduler, std::function<void()> wake);

  /// Loans wait, perhaps.
  void LoansWait() { loans_wait_ = true; }
  /// Takes a loan, begins it, or gives it back. To be called when woken, and a few times a second,
  /// by one thread.
  void Look(Time now);
  /// True while it has a loan.
  bool busy() const;
  /// Gives back what is not done.
  void Stop();

 private:
  /// A loan, and what was computed of it. Shared with the threads that compute.
  struct Work {
    Loan loan;
    std::shared_ptr<SweepRun> run;
    Mutex mutex;
    std::vector<SolvedCell> solved ABSL_GUARDED_BY(mutex);
  };

  void Take();
  /// Reads the sweep of a loan.
  void Fetch(const Loan& loan);
  /// Lets idle workers compute the cells of a loan.
  void Begin(const Loan& loan, const v1::Job& job);
  /// Stores what was computed.
  void Return();
  void Refuse(const Loan& loan);
  /// The loan is not ours any more.
  void Forget();

  SharedStore& store_;
  const Clock& clock_;
  const JobOptions& options_;
  const std::string worker_;
  Scheduler& scheduler_;
  const std::function<void()> wake_;
  std::atomic<bool> loans_wait_ = true;

  // Of the thread that looks.
  Time last_take_ = {};
  /// Since when the workers have had something else to do.
  Time busy_since_ = {};
  /// Null: no cells are computed.
  std::shared_ptr<Work> work_;

  mutable Mutex mutex_;
  /// The store is being asked for something.
  bool asking_ ABSL_GUARDED_BY(mutex_) = false;
  /// A loan that is to be begun, with its sweep.
  std::optional<std::pair<Loan, v1::Job>> fetched_ ABSL_GUARDED_BY(mutex_);
  /// Ours, in whatever stage.
  std::optional<Loan> loan_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace contact
