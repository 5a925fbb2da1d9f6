#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>

#include "contact/v1/job_service.pb.h"
#include "jobs/job/errors.h"
#include "jobs/job/job_options.h"
#include "jobs/log/jobs_cursor.h"
#include "jobs/log/log_cursor.h"
#include "jobs/read/artifact_reader.h"

namespace contact {

class BackupFile;
class Clock;
class IdSource;
class Store;

/// Owns the life of every job: accepts, queues, runs on worker threads, records, cancels.
///
/// Every call is thread-safe and returns without waiting for disk or worker; its callback runs
/// once, on a thread of the manager or the store, after what it reports is committed. Callbacks
/// must not block. Call `Stop` before destruction; callbacks all run before `Stop` returns.
class JobManager {
 public:
  template <class T>
  using Callback = std::function<void(Result<T>)>;
  /// Answers true once nobody waits for the answer of a call any more, so that work on it that has
  /// not begun is left out. May be asked until the call's callback is called. Empty: somebody
  /// always waits.
  using Abandoned = std::function<bool()>;

  /// Takes over what the store holds: jobs that were running when the process ended are queued
  /// again with reason SERVER_RESTARTED. Starts the workers.
  JobManager(Store& store, const Clock& clock, IdSource& ids, JobOptions options);
  ~JobManager();

  /// Checks and stores a job; `done` gets it in state QUEUED. A request with a `request_id` that
  /// was used before gets the job of that request.
  void Create(v1::CreateJobRequest request, Callback<v1::Job> done, Abandoned abandoned = {});
  /// The job with ledger and artifacts; of a running job, what its run has brought so far.
  void Get(const std::string& name, Callback<v1::Job> done);
  /// A page of job headers, newest first.
  void List(const v1::ListJobsRequest& request, Callback<v1::ListJobsResponse> done);
  /// Takes the job from the queue or asks its run to stop; `done` gets the job as it is then. No
  /// error if the job has ended.
  void Cancel(const v1::CancelJobRequest& request, Callback<v1::Job> done);
  /// Deletes a job that has ended, with its log.
  void Delete(const v1::DeleteJobRequest& request, Callback<bool> done);

  /// The recorded trajectory of a job, decimated to what the request allows.
  void Series(const v1::GetSeriesRequest& request, Callback<v1::Series> done,
              Abandoned abandoned = {});

  /// Opens a cursor over the log of a job, and the job as it is (without ledger) beside it.
  /// `wake` is called, from any thread and possibly more often than needed, when Read may have
  /// something new; it must not block and must not call the cursor from within. A call that has
  /// begun may go on while the cursor is destroyed. Cursors must not outlive the store.
  struct Watched {
    v1::Job snapshot;
    std::unique_ptr<LogCursor> cursor;
    std::chrono::milliseconds bookmark_interval{0};
    bool paced = false;  ///< The cursor may have something new because time has passed.
  };
  void Watch(const v1::WatchJobRequest& request, std::function<void()> wake,
             Callback<Watched> done);

  /// Copies the store into a file of its own, while everything goes on. `stop` gives it up.
  void Backup(std::stop_token stop, Callback<std::shared_ptr<BackupFile>> done);

  /// A cursor over the headers of all jobs that match a filter, and over their changes.
  struct WatchedJobs {
    std::unique_ptr<JobsCursor> cursor;
    std::chrono::milliseconds bookmark_interval{0};
  };
  /// Opens such a cursor. `wake` as above.
  Result<WatchedJobs> Watch(const v1::WatchJobsRequest& request, std::function<void()> wake);

  /// Opens an artifact of an ended job. `wake` as above.
  void ReadArtifact(const v1::ReadArtifactRequest& request, std::function<void()> wake,
                    Callback<std::unique_ptr<ArtifactReader>> done);

  /// Numbers of GetServerInfo: workers, queued and running jobs, limits.
  v1::ServerInfo Info() const;

  /// Refuses new jobs with SERVER_DRAINING from now on.
  void Drain();

  /// Stops the workers, puts running jobs back into the queue without burning their attempt, and
  /// waits for the threads. Idempotent.
  void Stop();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace contact
