#include "jobs/job_creator.h"

#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "jobs/job/lifecycle.h"
#include "jobs/predict.h"
#include "jobs/read/create_rules.h"
#include "storage/job_parts.h"
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

// The rules that the scenario or sweep breaks, with paths from the job.
std::vector<Violation> CheckSpec(const v1::Job& job, const JobOptions& options) {
  const std::int64_t memory = options.max_budget.memory_bytes;
  if (job.has_sweep()) {
    DecodedSweep plan = DecodeSweep(job.sweep(), options.scenario_limits);
    return Complete(
        std::move(plan.violations), "sweep", [&] { return FixedMemory(job.sweep(), plan); },
        memory);
  }
  if (!job.has_scenario()) return {};
  DecodedScenario decoded = DecodeScenario(job.scenario(), options.scenario_limits);
  return Complete(
      std::move(decoded.violations), "scenario", [&] { return FixedMemory(decoded.scenario); },
      memory);
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
  bool reserved;
  // The first events of its log.
  std::vector<v1::Event> events = {};
};

void JobCreator::Create(const Principal& caller, v1::CreateJobRequest request,
                        Callback<v1::Job> done, Abandoned abandoned) {
  if (draining_) return done(MakeError(Reason::kServerDraining));
  const bool reserved = !request.validate_only() && parts_.scheduler.Reserve();
  // A full queue still answers a request that was accepted before.
  if (!reserved && !request.validate_only() && request.request_id().empty()) {
    return done(QueueFull(parts_.options.max_queued_jobs));
  }
  const auto creation = std::make_shared<Creation>(Creation{{caller.name, caller.tenant},
                                                            std::move(request),
                                                            std::move(done),
                                                            std::move(abandoned),
                                                            reserved});
  if (!parts_.executor.Post([this, creation] { Check(creation); })) {
    Refuse(*creation, MakeError(Reason::kServerDraining));
  }
}

void JobCreator::Refuse(const Creation& creation, Error error) const {
  if (creation.reserved) parts_.scheduler.Release();
  creation.done(std::move(error));
}

void JobCreator::Check(const std::shared_ptr<Creation>& creation) const {
  if (creation->abandoned && creation->abandoned()) {
    return Refuse(*creation, MakeError(Reason::kDeadlineExceeded));
  }
  v1::CreateJobRequest& request = creation->request;
  std::vector<Violation> of_request = CheckCreate(request, parts_.options.max_budget);
  std::vector<Violation> of_spec = CheckSpec(request.job(), parts_.options);
  if (!of_request.empty() || !of_spec.empty()) {
    return Refuse(*creation, Invalid(std::move(of_request), std::move(of_spec)));
  }
  v1::Job job = TakeRequested(request.mutable_job());
  if (request.validate_only()) {
    Predict(parts_.options.scenario_limits, &job);
    return creation->done(std::move(job));
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
  parts_.store.Create({job, creation->request.request_id(), creation->events, creation->reserved},
                      [this, creation](absl::StatusOr<StoredJob> stored) {
                        if (stored.ok()) return Accept(*creation, *std::move(stored));
                        const bool full =
                            !creation->reserved && absl::IsResourceExhausted(stored.status());
                        Refuse(*creation, full ? QueueFull(parts_.options.max_queued_jobs)
                                               : ToError(stored.status(), ""));
                      });
}

void JobCreator::Accept(Creation& creation, StoredJob stored) const {
  if (!stored.created) {
    if (creation.reserved) parts_.scheduler.Release();
    return parts_.reader.Answer(std::move(stored), creation.done);
  }
  v1::Job& job = stored.job;
  parts_.options.metrics->Moved(v1::Job::STATE_UNSPECIFIED, job);
  MoveSpec(creation.request.mutable_job(), &job);
  parts_.scheduler.Enqueue(job, creation.events);
  creation.done(std::move(job));
}

}  // namespace contact
