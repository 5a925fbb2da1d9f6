#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <vector>

#include "base/clock.h"
#include "base/mutex.h"
#include "jobs/job/job_options.h"
#include "jobs/job/lifecycle.h"
#include "jobs/log/job_log.h"
#include "jobs/run/assignment.h"
#include "jobs/run/log_writer.h"
#include "jobs/run/sweep_run.h"
#include "storage/store.h"

namespace contact {

/// Runs a sweep on the worker that took it, with the help of idle ones. Whoever has computed a cell
/// puts it beside the others that are finished; one of those who compute at a time hands them to
/// the log, which is written in batches, and nobody waits for it unless too many are finished.
/// Cells that an earlier attempt has stored are not computed again.
class SweepRunner {
 public:
  /// All outlive the runner.
  SweepRunner(Store& store, const Clock& clock, const JobOptions& options,
              const Assignment& assignment, LogWriter& writer);

  /// The end of the job. What it amounts to is in the record of the assignment.
  Transition Run(const v1::Sweep& sweep);

 private:
  bool ReadDone(std::vector<bool>* done);
  void Count(v1::Job::State state, v1::Job::Convergence convergence)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(log_mutex_);
  void TakeCell(SolvedCell solved);
  bool PutFinished(SolvedCell solved);
  bool SomeFinished();
  void StoreFinished() ABSL_EXCLUSIVE_LOCKS_REQUIRED(log_mutex_);
  void StoreCell(SolvedCell solved) ABSL_EXCLUSIVE_LOCKS_REQUIRED(log_mutex_);
  /// Writes what was handed to the log, unless another thread is at it.
  void WriteIfDue();
  void Publish() ABSL_EXCLUSIVE_LOCKS_REQUIRED(log_mutex_);
  Transition Conclude(const std::vector<Violation>& advice);

  Store& store_;
  const Clock& clock_;
  const JobOptions& options_;
  const Assignment& assignment_;

  Mutex log_mutex_;  ///< Held while the writer waits for the disk.
  LogWriter& writer_ ABSL_GUARDED_BY(log_mutex_);
  v1::Progress progress_ ABSL_GUARDED_BY(log_mutex_);
  std::chrono::steady_clock::time_point last_progress_ ABSL_GUARDED_BY(log_mutex_) = {};

  Mutex mutex_ ABSL_ACQUIRED_AFTER(log_mutex_);               ///< Held for an instant.
  std::vector<SolvedCell> finished_ ABSL_GUARDED_BY(mutex_);  ///< And not in the log yet.
};

}  // namespace contact
