#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
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
  /// Lets others compute if the run is asked to. False: the cell under way is not left.
  bool Yield();
  /// Notes which cells an earlier attempt has stored. A damaged one is computed again. False: the
  /// log cannot be read.
  bool ReadDone(std::vector<bool>* done);
  /// Counts a cell that is in the log.
  void Count(v1::Job::State state, v1::Job::Convergence convergence)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(log_mutex_);
  /// Takes a computed cell, on any computing thread. If another thread holds the log, the cell
  /// stays in finished_: the holder stores what is there before it releases the log.
  void TakeCell(SolvedCell solved);
  /// Adds to finished_. True if so much is finished that the caller must store it.
  bool PutFinished(SolvedCell solved);
  /// True if finished_ is not empty.
  bool SomeFinished();
  /// Takes the oldest of finished_; nothing: it is empty.
  std::optional<SolvedCell> NextFinished();
  /// Empties finished_ into the log.
  void StoreFinished() ABSL_EXCLUSIVE_LOCKS_REQUIRED(log_mutex_);
  /// Adds a cell to the log, directly after the chunks of its trajectory.
  void StoreCell(SolvedCell solved) ABSL_EXCLUSIVE_LOCKS_REQUIRED(log_mutex_);
  /// Counts cells that others have stored in the log.
  void TakeCounts(const CellCounts& counts);
  /// Adds them to the progress.
  void CountStored() ABSL_EXCLUSIVE_LOCKS_REQUIRED(log_mutex_);
  /// Writes what was handed to the log, unless another thread is at it.
  void WriteIfDue();
  /// Tells the progress to the record and to watchers.
  void Publish() ABSL_EXCLUSIVE_LOCKS_REQUIRED(log_mutex_);
  /// Stores what is left, and puts what the sweep amounts to into the record.
  Transition Conclude(const std::vector<Violation>& advice);

  Store& store_;
  const Clock& clock_;
  const JobOptions& options_;
  const Assignment& assignment_;

  /// Guards the log. Held while the writer waits for the disk.
  Mutex log_mutex_;
  LogWriter& writer_ ABSL_GUARDED_BY(log_mutex_);
  /// Counts of cells.
  v1::Progress progress_ ABSL_GUARDED_BY(log_mutex_);
  /// When progress was published last.
  std::chrono::steady_clock::time_point last_progress_ ABSL_GUARDED_BY(log_mutex_) = {};

  /// Guards what is finished. Held for an instant.
  Mutex mutex_ ABSL_ACQUIRED_AFTER(log_mutex_);
  /// Computed cells that are not in the log yet.
  std::deque<SolvedCell> finished_ ABSL_GUARDED_BY(mutex_);
  /// Cells that others have stored, and that are not counted yet.
  CellCounts stored_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace contact
