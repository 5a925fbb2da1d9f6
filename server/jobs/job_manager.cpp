#include "jobs/job_manager.h"

#include <string>
#include <utility>

#include "base/future.h"
#include "jobs/read/update_rules.h"
#include "jobs/schedule/scheduler.h"

namespace contact {

JobManager::JobManager(Store& store, const Clock& clock, IdSource& ids, JobOptions options)
    : JobManager(store, clock, ids, std::move(options), [&](JobManager& manager) {
        auto scheduler = std::make_unique<Scheduler>(store, clock, manager.options_, manager.feed_,
                                                     manager.quotas_);
        scheduler->Recover();  // All of them, before the first is begun.
        scheduler->Start();
        return scheduler;
      }) {}

JobManager::JobManager(SharedStore& store, const Clock& clock, IdSource& ids, JobOptions options,
                       const SharedOptions& shared)
    : JobManager(store, clock, ids, std::move(options), [&](JobManager& manager) {
        return std::make_unique<SharedJobs>(store, clock, manager.options_, shared, manager.feed_);
      }) {}

JobManager::JobManager(Store& store, const Clock& clock, IdSource& ids, JobOptions options,
                       const MakeUnfinished& make)
    : store_(store),
      options_(std::move(options)),
      quotas_(options_.owner_limits, clock),
      unfinished_(make(*this)),
      retention_(store, clock, options_.retention, feed_),
      watchers_(options_.max_watchers, options_.admin_slots),
      reader_(store, options_, *unfinished_, executor_),
      creator_({store, clock, ids, options_, *unfinished_, quotas_, reader_, executor_}),
      watches_({{store, decoder_}, clock, *unfinished_, reader_, feed_, watchers_}),
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
                        const Callback<v1::Job>& done) {
  const std::string& uid = request.expected_uid();
  // Of a job that has ended the scheduler knows nothing.
  Callback<v1::Job> checked = [uid, done](Result<v1::Job> job) {
    const bool other = job.ok() && !uid.empty() && job.value().uid() != uid;
    done(other ? UidMismatch(job.value().name(), job.value().uid()) : std::move(job));
  };
  const auto cancel = [this, caller, name = request.name(), uid, checked = std::move(checked)] {
    unfinished_->Cancel(name, uid, [this, caller, name, checked](const absl::Status& status) {
      if (!status.ok()) return checked(ToError(status, name));
      reader_.Get(caller, name, checked);
    });
  };
  IfAllowed(caller, request.name(), cancel, done);
}

void JobManager::Update(const Principal& caller, const v1::UpdateJobRequest& request,
                        const Callback<v1::Job>& done) {
  const Result<JobRemark> remark = ToRemark(request);
  if (!remark.ok()) return done(remark.error());
  const std::string& name = request.job().name();
  const auto change = [this, caller, name, remark = remark.value(), done] {
    store_.Remark(remark, [this, caller, name, done](const absl::StatusOr<JobOwner>& whose) {
      if (!whose.ok()) return done(ToError(whose.status(), name));
      feed_.Changed(whose->tenant, name);
      reader_.Get(caller, name, done);
    });
  };
  IfAllowed(caller, name, change, done);
}

void JobManager::Delete(const Principal& caller, const v1::DeleteJobRequest& request,
                        const Callback<bool>& done) {
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
  const Demand demand = unfinished_->demand();
  info.set_workers(static_cast<int>(demand.threads));
  info.set_queued_jobs(static_cast<int>(demand.queued));
  info.set_running_jobs(static_cast<int>(demand.running));
  *info.mutable_limits() = LimitsOf(options_);
  return info;
}

void JobManager::InfoFor(const Principal& caller, Callback<v1::ServerInfo> done) const {
  const JobOwner whose{caller.name, caller.tenant};
  store_.OwnerBytes(
      whose, [this, whose, done = std::move(done)](const absl::StatusOr<std::int64_t>& bytes) {
        if (!bytes.ok()) return done(ToError(bytes.status(), ""));
        unfinished_->CountOf(
            whose, [this, whose, bytes = *bytes, done](const absl::StatusOr<OwnerCounts>& counts) {
              if (!counts.ok()) return done(ToError(counts.status(), ""));
              done(WithQuotas(Info(), whose, *counts, bytes));
            });
      });
}

v1::ServerInfo JobManager::WithQuotas(v1::ServerInfo info, const JobOwner& whose,
                                      const OwnerCounts& counts, std::int64_t bytes) const {
  const auto add = [&info](v1::Quota::Resource resource, std::int64_t limit, std::int64_t used) {
    v1::Quota& quota = *info.add_quotas();
    quota.set_resource(resource);
    quota.set_limit(limit);
    quota.set_used(used);
  };
  add(v1::Quota::UNFINISHED_JOBS, options_.owner_limits.unfinished_jobs, counts.jobs);
  add(v1::Quota::CELLS, options_.owner_limits.cells, counts.cells);
  for (v1::Quota& quota : quotas_.Of(whose)) *info.add_quotas() = std::move(quota);
  add(v1::Quota::RUNNING_JOBS, options_.max_running_per_owner, counts.running);
  add(v1::Quota::STORED_BYTES, options_.owner_limits.stored_bytes, bytes);
  return info;
}

void JobManager::Stop() {
  creator_.Drain();
  executor_.Stop();
  decoder_.Stop();
  retention_.Stop();
  unfinished_->Stop();
  // Cancel and Update ask the store three times, each time once the answer before has come.
  for (int i = 0; i < 3; ++i) {
    Await<bool>([this](const auto& done) { store_.Flush([done] { done(true); }); });
  }
}

}  // namespace contact
