#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/mutex.h"
#include "jobs/run/sweep_run.h"
#include "jobs/schedule/scheduler.h"
#include "storage/shared_store.h"

namespace contact {

/// Lends cells of the sweeps that run here to workers that are idle elsewhere, half a second's work
/// at a time, so that little is lost with one that dies, and all end together.
class SweepLender {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// `worker`: WorkerProcess::name. The store outlives it and all that it has asked for.
  SweepLender(SharedStore& store, std::string worker, int threads)
      : store_(store), worker_(std::move(worker)), threads_(threads) {}

  /// Lends, and takes in what has come back. `idle`: threads elsewhere that have nothing to do. To
  /// be called a few times a second, by one thread.
  void Look(Time now, const std::vector<Scheduler::OwnSweep>& sweeps, int idle);
  /// Takes everything back without asking: the sweeps are to end.
  void TakeBack();

 private:
  /// A sweep, and what is lent of it.
  struct Sweep {
    std::shared_ptr<SweepRun> run;
    std::map<std::int64_t, SweepRun::Cells> lent = {};
    /// The store is being asked which loans have ended.
    bool asking = false;
    /// Cells that nobody had begun at the last look, less what was lent then; and when that was.
    std::int32_t waiting = 0;
    Time time = {};
    /// Cells that one thread computes in a second.
    double pace = 0;
  };

  /// Measures the pace.
  void Measure(Time now, Sweep* sweep) const;
  /// Cells of one loan.
  std::int32_t Size(const Sweep& sweep, int idle) const;
  /// Lends what is useful; returns the new loans.
  std::vector<Loan> LendSome(Sweep* sweep, int idle) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void Settle(const std::string& job, const Sweep& sweep);
  void TakeIn(const std::string& job, const std::vector<LoanEnd>& ends);

  SharedStore& store_;
  const std::string worker_;
  const int threads_;

  Mutex mutex_;
  /// By job.
  std::map<std::string, Sweep> sweeps_ ABSL_GUARDED_BY(mutex_);
  /// Number of the newest loan.
  std::int64_t numbers_ ABSL_GUARDED_BY(mutex_) = 0;
};

}  // namespace contact
