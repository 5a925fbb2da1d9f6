#include "jobs/job_manager.h"

#include <string>
#include <utility>

#include "base/future.h"

namespace contact {

JobManager::JobManager(Store& store, const Clock& clock, IdSource& ids, JobOptions options)
    : store_(store),
      options_(std::move(options)),
      scheduler_(store, clock, options_, feed_),
      retention_(store, clock, options_.retention, feed_),
      watchers_(options_.max_watchers),
      reader_(store, options_, scheduler_, executor_),
      creator_({store, clock, ids, options_, scheduler_, reader_, executor_}),
      watches_({{store, decoder_}, clock, scheduler_, reader_, feed_, watchers_}),
      recordings_(store, executor_, options_.scenario_limits, watchers_) {
  retention_.Start();
}

JobManager::~JobManager() { Stop(); }

void JobManager::Cancel(const v1::CancelJobRequest& request, Callback<v1::Job> done) {
  const std::string& name = request.name();
  const std::string& uid = request.expected_uid();
  // Of a job that has ended the scheduler knows nothing.
  auto checked = [uid, done = std::move(done)](Result<v1::Job> job) {
    const bool other = job.ok() && !uid.empty() && job.value().uid() != uid;
    done(other ? UidMismatch(job.value().name(), job.value().uid()) : std::move(job));
  };
  scheduler_.Cancel(name, uid,
                    [this, name, checked = std::move(checked)](const absl::Status& status) mutable {
                      if (!status.ok()) return checked(ToError(status, name));
                      reader_.Get(name, std::move(checked));
                    });
}

void JobManager::Delete(const v1::DeleteJobRequest& request, Callback<bool> done) {
  store_.Delete(
      request.name(), request.expected_uid(),
      [this, name = request.name(), done = std::move(done)](const absl::StatusOr<bool>& deleted) {
        if (!deleted.ok()) return done(ToError(deleted.status(), name));
        feed_.Changed(name);
        done(true);
      });
}

v1::ServerInfo JobManager::Info() const {
  v1::ServerInfo info;
  info.set_workers(options_.workers);
  info.set_queued_jobs(scheduler_.queued());
  info.set_running_jobs(scheduler_.running());
  *info.mutable_limits() = LimitsOf(options_);
  return info;
}

void JobManager::Stop() {
  creator_.Drain();
  executor_.Stop();
  decoder_.Stop();
  retention_.Stop();
  scheduler_.Stop();
  // Twice: what Cancel asks of the store first makes it ask once more.
  Await<bool>([this](const auto& done) {
    store_.Flush([this, done] { store_.Flush([done] { done(true); }); });
  });
}

}  // namespace contact
