#include "jobs/job_creator.h"

#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "jobs/job/lifecycle.h"
#include "jobs/predict.h"
#include "jobs/quota/places.h"
#include "jobs/read/create_rules.h"
#include "storage/job_parts.h"
#include "storage/refusals.h"
#include "wire/estimate.h"
#include "wire/scenario/scenario_codec.h"
#include "wire/sweep/sweep_codec.h"

namespace contact {
namespace {

// The violations of a spec in the field `spec` of the job, or else that its run would take more
// memory than the server gives it. A ledger that grows too large ends the run later.
std::vector<Violation> Complete(std::vector<Violation> violations, const std::string& spec,
                                const std::function<std::int64_t()>& estimate, std::int64_t most) {
  for (Violation& violation : violations) violation.field = spec + '.' + violation.field;
  if (!violations.empty() || most == 0) return violations;
  const std::int64_t memory = estimate();
  if (memory <= most) return {};
  return {{spec,
           fmt::format("would take about {} MB of memory; must take at most {} MB, the server's "
                       "limit",
                       memory / 1'000'000, most / 1'000'000),
           "take fewer bodies and contacts, or keep fewer trajectories"}};
}

// Why the disk takes no more jobs; nothing if it does. A large disk takes them while much is left,
// however full it is.
std::optional<Error> CheckDisk(const JobOptions& options) {
  constexpr std::int64_t kMuch = 10'000'000'000;
  if (options.max_disk_percent == 0) return std::nullopt;
  const DiskSpace disk = options.disk();
  if (disk.total == 0 || disk.free >= kMuch) return std::nullopt;
  const auto used = static_cast<int>(100 - 100.0 * static_cast<double>(disk.free) /
                                               static_cast<double>(disk.total));
  if (used <= options.max_disk_percent) return std::nullopt;
  return DiskFull(used, options.max_disk_percent, disk.free);
}

// What the check of a scenario or sweep finds.
struct CheckedSpec {
  // With paths from the job.
  std::vector<Violation> violations = {};
  // Of a sweep.
  std::int64_t cells = 0;
};

CheckedSpec CheckSpec(const v1::Job& job, const JobOptions& options) {
  const std::int64_t memory = options.max_budget.memory_bytes;
  if (job.has_sweep()) {
    DecodedSweep plan = DecodeSweep(job.sweep(), options.scenario_limits);
    auto violations = Complete(
        std::move(plan.violations), "sweep", [&] { return FixedMemory(job.sweep(), plan); },
        memory);
    const std::int64_t cells = violations.empty() ? plan.axes.cells() : 0;
    return {std::move(violations), cells};
  }
  if (!job.has_scenario()) return {};
  DecodedScenario decoded = DecodeScenario(job.scenario(), options.scenario_limits);
  return {Complete(
      std::move(decoded.violations), "scenario", [&] { return FixedMemory(decoded.scenario); },
      memory)};
}

// Moves the scenario or sweep.
void MoveSpec(v1::Job* from, v1::Job* to) {
  if (from->has_sweep()) {
    to->mutable_sweep()->Swap(from->mutable_sweep());
  } else {
    to->mutable_scenario()->Swap(from->mutable_scenario());
  }
}

// What of a requested job is the client's to say, and the title that follows from it. Takes the
// scenario or sweep out of it.
v1::Job TakeRequested(v1::Job* from) {
  v1::Job job;
  MoveSpec(from, &job);
  job.set_title(TitleOf(job));
  *job.mutable_labels() = from->labels();
  job.set_priority(from->priority());
  if (from->has_budget()) *job.mutable_budget() = from->budget();
  if (from->has_time_to_live()) *job.mutable_time_to_live() = from->time_to_live();
  return job;
}

}  // namespace

struct JobCreator::Creation {
  JobOwner whose;
  v1::CreateJobRequest request;
  Callback<v1::Job> done;
  Abandoned abandoned;
  // A place in the queue is kept for the job.
  bool reserved = false;
  // What it takes of its owner's limits.
  Quotas::Place held = {};
  // Why a limit forbids the job. A request that was accepted before is answered nevertheless.
  std::optional<Error> refusal = {};
  // What the store is to look at, where it counts for all processes.
  UnfinishedLimits limits = {};
  // The first events of its log.
  std::vector<v1::Event> events = {};
};

void JobCreator::Create(const Principal& caller, v1::CreateJobRequest request,
                        Callback<v1::Job> done, Abandoned abandoned) {
  if (draining_) return done(MakeError(Reason::kServerDraining));
  const auto creation = std::make_shared<Creation>(Creation{
      {caller.name, caller.tenant}, std::move(request), std::move(done), std::move(abandoned)});
  if (!creation->request.validate_only()) creation->refusal = Reserve(caller, creation.get());
  if (creation->refusal && creation->request.request_id().empty()) {
    return Refuse(*creation, *creation->refusal);
  }
  if (!parts_.executor.Post([this, creation] { Check(creation); })) {
    Refuse(*creation, MakeError(Reason::kServerDraining));
  }
}

std::optional<Error> JobCreator::Reserve(const Principal& caller, Creation* creation) const {
  const int places = OpenTo(caller, parts_.options.max_queued_jobs, parts_.options.admin_slots);
  if (parts_.unfinished.counts_in_store()) {
    const OwnerLimits& owner = parts_.options.owner_limits;
    creation->limits = {places, owner.unfinished_jobs, owner.cells};
    return std::nullopt;
  }
  Result<Quotas::Place> held = parts_.quotas.Take(creation->whose, v1::Quota::UNFINISHED_JOBS);
  if (!held.ok()) return held.error();
  if (!parts_.unfinished.Reserve(places)) return QueueFull(places);
  creation->reserved = true;
  creation->held = std::move(held.value());
  return std::nullopt;
}

std::optional<Error> JobCreator::Admit(Creation* creation, std::int64_t cells) const {
  if (auto full = CheckDisk(parts_.options)) return full;
  if (cells == 0 || parts_.unfinished.counts_in_store()) return std::nullopt;
  Result<Quotas::Place> held = parts_.quotas.Take(creation->whose, v1::Quota::CELLS, cells);
  if (!held.ok()) return held.error();
  creation->held = Quotas::Both(std::move(creation->held), std::move(held.value()));
  return std::nullopt;
}

void JobCreator::Refuse(Creation& creation, Error error) const {
  GiveBack(&creation);
  creation.done(std::move(error));
}

void JobCreator::GiveBack(Creation* creation) const {
  if (std::exchange(creation->reserved, false)) parts_.unfinished.Release();
  creation->held = nullptr;
}

void JobCreator::Check(const std::shared_ptr<Creation>& creation) const {
  if (creation->abandoned && creation->abandoned()) {
    return Refuse(*creation, MakeError(Reason::kDeadlineExceeded));
  }
  v1::CreateJobRequest& request = creation->request;
  std::vector<Violation> of_request = CheckCreate(request, parts_.options.max_budget);
  CheckedSpec spec = CheckSpec(request.job(), parts_.options);
  if (!of_request.empty() || !spec.violations.empty()) {
    return Refuse(*creation, Invalid(std::move(of_request), std::move(spec.violations)));
  }
  v1::Job job = TakeRequested(request.mutable_job());
  if (request.validate_only()) {
    Predict(parts_.options.scenario_limits, &job);
    return creation->done(std::move(job));
  }
  if (spec.cells > 0) job.mutable_progress()->set_cells(static_cast<std::int32_t>(spec.cells));
  if (!creation->refusal) creation->refusal = Admit(creation.get(), spec.cells);
  if (creation->refusal && request.request_id().empty()) {
    return Refuse(*creation, *creation->refusal);
  }
  *request.mutable_job() = std::move(job);
  Commit(creation);
}

void JobCreator::Commit(const std::shared_ptr<Creation>& creation) const {
  v1::Job& job = *creation->request.mutable_job();
  job.set_name("jobs/" + parts_.ids.NextId());
  job.set_uid(parts_.ids.NextUuid());
  job.set_owner(creation->whose.owner);
  job.set_tenant(creation->whose.tenant);
  creation->events = {
      Apply({v1::Job::QUEUED, reason::kWaitingForWorker}, parts_.clock.Now(), &job)};
  parts_.store.Create({job, creation->request.request_id(), creation->events, !creation->refusal,
                       parts_.quotas.max_stored_bytes(), creation->limits},
                      [this, creation](absl::StatusOr<StoredJob> stored) {
                        if (stored.ok()) return Accept(*creation, *std::move(stored));
                        Refuse(*creation, ErrorOf(stored.status(), *creation));
                      });
}

Error JobCreator::ErrorOf(const absl::Status& status, const Creation& creation) const {
  if (creation.refusal && absl::IsResourceExhausted(status)) return *creation.refusal;
  const auto has = [&status](const char* payload) -> std::optional<std::int64_t> {
    const auto told = status.GetPayload(payload);
    return told ? std::optional(std::stoll(std::string(*told))) : std::nullopt;
  };
  const auto exceeded = [&](v1::Quota::Resource resource, std::int64_t used, std::int64_t amount) {
    return parts_.quotas.Exceeded(creation.whose, resource, used, amount);
  };
  if (has(kWaitingPayload)) return QueueFull(static_cast<int>(creation.limits.waiting));
  if (const auto bytes = has(kOwnerBytesPayload)) {
    return exceeded(v1::Quota::STORED_BYTES, *bytes, 0);
  }
  if (const auto jobs = has(kOwnerJobsPayload)) {
    return exceeded(v1::Quota::UNFINISHED_JOBS, *jobs, 1);
  }
  if (const auto cells = has(kOwnerCellsPayload)) {
    return exceeded(v1::Quota::CELLS, *cells, creation.request.job().progress().cells());
  }
  return ToError(status, "");
}

void JobCreator::Accept(Creation& creation, StoredJob stored) const {
  if (!stored.created) {
    GiveBack(&creation);
    return parts_.reader.Answer(std::move(stored), creation.done);
  }
  v1::Job& job = stored.job;
  parts_.options.metrics->Moved(v1::Job::STATE_UNSPECIFIED, job);
  MoveSpec(creation.request.mutable_job(), &job);
  parts_.unfinished.Enqueue(job, creation.events, std::move(creation.held));
  creation.done(std::move(job));
}

}  // namespace contact
