#include "jobs/job_manager.h"

#include <string>
#include <utility>

#include "base/future.h"

namespace contact {

JobManager::JobManager(Store& store, const Clock& clock, IdSource& ids, JobOptions options)
    : store_(store),
      options_(std::move(options)),
      quotas_(options_.owner_limits, clock),
      scheduler_(store, clock, options_, feed_, quotas_),
      retention_(store, clock, options_.retention, feed_),
      watchers_(options_.max_watchers, options_.admin_slots),
      reader_(store, options_, scheduler_, executor_),
      creator_({store, clock, ids, options_, scheduler_, quotas_, reader_, executor_}),
      watches_({{store, decoder_}, clock, scheduler_, reader_, feed_, watchers_}),
      recordings_(store, executor_, options_.scenario_limits, watchers_) {
  retention_.Start();
}

JobManager::~JobManager() { Stop(); }

void JobManager::IfAllowed(const Principal& caller, const std::string& name,
                           std::function<void()> change, std::function<void(Error)> refuse) {
  store_.Owner(caller.tenant, name,
               [caller, name, change = std::move(change),
                refuse = std::move(refuse)](const absl::StatusOr<JobOwner>& whose) {
                 if (!whose.ok()) return refuse(ToError(whose.status(), name));
                 const bool own = whose->owner == caller.name;
                 if (own || May(caller, Permission::kChangeAny)) return change();
                 refuse(NotYours(name, whose->owner));
               });
}

void JobManager::Cancel(const Principal& caller, const v1::CancelJobRequest& request,
                        Callback<v1::Job> done) {
  const std::string& uid = request.expected_uid();
  // Of a job that has ended the scheduler knows nothing.
  Callback<v1::Job> checked = [uid, done](Result<v1::Job> job) {
    const bool other = job.ok() && !uid.empty() && job.value().uid() != uid;
    done(other ? UidMismatch(job.value().name(), job.value().uid()) : std::move(job));
  };
  const auto cancel = [this, caller, name = request.name(), uid, checked = std::move(checked)] {
    scheduler_.Cancel(name, uid, [this, caller, name, checked](const absl::Status& status) {
      if (!status.ok()) return checked(ToError(status, name));
      reader_.Get(caller, name, checked);
    });
  };
  IfAllowed(caller, request.name(), cancel, done);
}

void JobManager::Delete(const Principal& caller, const v1::DeleteJobRequest& request,
                        Callback<bool> done) {
  const auto remove = [this, request, done] {
    const auto removed = [this, name = request.name(), done](const auto& whose) {
      if (!whose.ok()) return done(ToError(whose.status(), name));
      feed_.Changed(whose->tenant, name);
      done(true);
    };
    store_.Delete(request.name(), request.expected_uid(), removed);
  };
  IfAllowed(caller, request.name(), remove, done);
}

v1::ServerInfo JobManager::Info() const {
  v1::ServerInfo info;
  info.set_workers(options_.workers);
  info.set_queued_jobs(scheduler_.queued());
  info.set_running_jobs(scheduler_.running());
  *info.mutable_limits() = LimitsOf(options_);
  return info;
}

void JobManager::InfoFor(const Principal& caller, Callback<v1::ServerInfo> done) const {
  const JobOwner whose{caller.name, caller.tenant};
  store_.OwnerBytes(whose,
                    [this, whose, done = std::move(done)](absl::StatusOr<std::int64_t> bytes) {
                      if (!bytes.ok()) return done(ToError(bytes.status(), ""));
                      v1::ServerInfo info = Info();
                      for (v1::Quota& quota : quotas_.Of(whose))
                        *info.add_quotas() = std::move(quota);
                      v1::Quota& running = *info.add_quotas();
                      running.set_resource(v1::Quota::RUNNING_JOBS);
                      running.set_limit(options_.max_running_per_owner);
                      running.set_used(scheduler_.RunningOf(whose));
                      v1::Quota& stored = *info.add_quotas();
                      stored.set_resource(v1::Quota::STORED_BYTES);
                      stored.set_limit(quotas_.max_stored_bytes());
                      stored.set_used(*bytes);
                      done(std::move(info));
                    });
}

void JobManager::Stop() {
  creator_.Drain();
  executor_.Stop();
  decoder_.Stop();
  retention_.Stop();
  scheduler_.Stop();
  // Cancel asks the store three times, each time once the answer before has come.
  for (int i = 0; i < 3; ++i) {
    Await<bool>([this](const auto& done) { store_.Flush([done] { done(true); }); });
  }
}

}  // namespace contact
