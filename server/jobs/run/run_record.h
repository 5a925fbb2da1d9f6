#pragma once

#include <utility>

#include "base/mutex.h"
#include "contact/v1/job.pb.h"

namespace contact {

/// What the run of a job has brought so far: ledger, progress and warnings, as fields of a Job.
/// Written by its worker, read by whoever asks for the job. Thread-safe.
class RunRecord {
 public:
  /// Changes it under its lock.
  template <class Change>
  void Do(Change change) {
    const MutexLock lock(mutex_);
    change(job_);
  }

  /// All of it, or the progress only.
  v1::Job Get(bool with_ledger) const {
    const MutexLock lock(mutex_);
    if (with_ledger) return job_;
    v1::Job job;
    if (job_.has_progress()) *job.mutable_progress() = job_.progress();
    return job;
  }

  /// Empties it, and returns what it was.
  v1::Job Take() {
    const MutexLock lock(mutex_);
    return std::exchange(job_, {});
  }

 private:
  mutable Mutex mutex_;
  v1::Job job_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace contact
