#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "contact/v1/job.pb.h"
#include "identity/principal.h"
#include "jobs/log/job_log.h"
#include "jobs/run/run_record.h"
#include "storage/records.h"
#include "storage/shared_store.h"

namespace contact {

/// What a server knows of the jobs that have not ended, and how it lets them in and cancels them.
/// A Scheduler, if this process alone has the store; SharedJobs, if others share it. Thread-safe;
/// no call waits.
class Unfinished {
 public:
  using Done = std::function<void(const absl::Status&)>;

  Unfinished() = default;
  virtual ~Unfinished() = default;
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

  /// True if the store counts what is limited, for all processes: NewJob::limits.
  virtual bool counts_in_store() const = 0;
  /// Keeps a place for a job that is being stored. False: there are `most` jobs in the queue.
  virtual bool Reserve(int most) = 0;
  /// Gives it back, if the job does not come.
  virtual void Release() = 0;
  /// Fills it with a job that is stored now, all of it, with the first events of its log. `held`
  /// goes when the job ends. On the store's thread.
  virtual void Enqueue(v1::Job job, std::vector<v1::Event> events,
                       std::shared_ptr<const void> held) = 0;

  /// Takes a job from the queue, or asks its worker to stop. `done` is called on the store's
  /// thread when that is stored, or at once if there is nothing to do. ABORTED, with the payload
  /// kUidPayload: the job's uid is not `expected_uid`, if that is not empty.
  virtual void Cancel(const std::string& name, const std::string& expected_uid, Done done) = 0;

  /// What is in memory of the log of a stored job. To be called on the store's thread.
  virtual std::shared_ptr<JobLog> Log(const v1::Job& job) = 0;
  /// What the run of the job has brought so far, as far as that is known here; else null.
  virtual std::shared_ptr<const RunRecord> Record(const v1::Job& job) const = 0;

  /// How many jobs wait and run, and on how many threads.
  virtual Demand demand() const = 0;
  /// As that, of one owner.
  virtual void CountOf(const JobOwner& whose,
                       std::function<void(absl::StatusOr<OwnerCounts>)> done) = 0;

  /// Ends what runs in this process; its jobs wait for another start, or another worker.
  /// Idempotent.
  virtual void Stop() = 0;
};

}  // namespace contact
