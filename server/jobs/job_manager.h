#pragma once

#include <functional>
#include <memory>
#include <string>

#include "base/clock.h"
#include "base/executor.h"
#include "base/ids.h"
#include "contact/v1/job_service.pb.h"
#include "identity/principal.h"
#include "jobs/cluster/shared_jobs.h"
#include "jobs/job/callback.h"
#include "jobs/job/job_options.h"
#include "jobs/job_creator.h"
#include "jobs/job_reader.h"
#include "jobs/log/job_feed.h"
#include "jobs/quota/places.h"
#include "jobs/quota/quotas.h"
#include "jobs/read/recordings.h"
#include "jobs/schedule/retention.h"
#include "jobs/schedule/unfinished.h"
#include "jobs/watches.h"
#include "storage/store.h"

namespace contact {

/// Owns the life of every job: what accepts, queues, runs, records, reads and deletes jobs. Each
/// call goes to the part that answers it.
///
/// Every call of a part is thread-safe and returns without waiting for disk or worker. Call `Stop`
/// before destruction; all callbacks run before `Stop` returns.
class JobManager {
 public:
  /// For a store that this process has alone. Takes over what it holds: jobs that were running when
  /// the process ended are queued again with reason SERVER_RESTARTED. Starts the workers. Store,
  /// clock and ids outlive the manager.
  JobManager(Store& store, const Clock& clock, IdSource& ids, JobOptions options);
  /// For a store that others share.
  JobManager(SharedStore& store, const Clock& clock, IdSource& ids, JobOptions options,
             const SharedOptions& shared);
  ~JobManager();
  JobManager(const JobManager&) = delete;
  JobManager& operator=(const JobManager&) = delete;

  /// Accepts jobs.
  JobCreator& creator() { return creator_; }
  /// Tells what jobs are.
  const JobReader& reader() const { return reader_; }
  /// Follows jobs.
  Watches& watches() { return watches_; }
  /// Reads what jobs have recorded.
  Recordings& recordings() { return recordings_; }
  /// Limits what each principal may have.
  Quotas& quotas() { return quotas_; }

  /// Takes the job from the queue or asks its run to stop; `done` gets the job as it is then. No
  /// error if the job has ended. PERMISSION_DENIED: the job is not the caller's, nor may the caller
  /// change those of others of the tenant.
  void Cancel(const Principal& caller, const v1::CancelJobRequest& request,
              const Callback<v1::Job>& done);
  /// Changes what people say of a job, whatever its state; `done` gets the job as it is then.
  /// PERMISSION_DENIED: as Cancel.
  void Update(const Principal& caller, const v1::UpdateJobRequest& request,
              const Callback<v1::Job>& done);
  /// Deletes a job that has ended, with its log. PERMISSION_DENIED: as Cancel.
  void Delete(const Principal& caller, const v1::DeleteJobRequest& request,
              const Callback<bool>& done);

  /// What GetServerInfo tells of jobs: workers, queued and running jobs, limits.
  v1::ServerInfo Info() const;
  /// As Info, with what the caller may have and has.
  void InfoFor(const Principal& caller, Callback<v1::ServerInfo> done) const;

  /// Stops the workers, puts running jobs back into the queue without burning their attempt, and
  /// waits for the threads. Refuses new jobs. Idempotent.
  void Stop();

 private:
  /// Adds what the owner may have and has.
  v1::ServerInfo WithQuotas(v1::ServerInfo info, const JobOwner& whose, const OwnerCounts& counts,
                            std::int64_t bytes) const;
  /// Calls `change` if the caller may change the job, else `refuse` with the reason.
  void IfAllowed(const Principal& caller, const std::string& name, std::function<void()> change,
                 std::function<void(Error)> refuse);

  /// Makes what knows the jobs that have not ended.
  using MakeUnfinished = std::function<std::unique_ptr<Unfinished>(JobManager&)>;
  JobManager(Store& store, const Clock& clock, IdSource& ids, JobOptions options,
             const MakeUnfinished& make);

  Store& store_;
  const JobOptions options_;
  JobFeed feed_;
  Quotas quotas_;
  const std::unique_ptr<Unfinished> unfinished_;
  Retention retention_;
  /// Checks scenarios and reads series: too long for the callers' threads.
  Executor executor_{"checker"};
  /// Decodes what watchers read from the store.
  Executor decoder_{"decoder"};
  /// The places of those who watch jobs or read artifacts.
  const Places watchers_;
  const JobReader reader_;
  JobCreator creator_;
  Watches watches_;
  Recordings recordings_;
};

}  // namespace contact
