#include "jobs/job_runner.h"

#include <chrono>
#include <exception>
#include <future>
#include <utility>
#include <vector>

#include "jobs/run_recorder.h"
#include "jobs/sweep_runner.h"
#include "version.h"
#include "wire/result_codec.h"
#include "wire/scenario_codec.h"
#include "wire/spec_digest.h"

namespace contact {
namespace {

std::future<absl::StatusOr<StoredJob>> ReadSpec(Store& store, const std::string& name) {
  const auto promise = std::make_shared<std::promise<absl::StatusOr<StoredJob>>>();
  store.Read(name, JobPart::kSpec,
             [promise](absl::StatusOr<StoredJob> job) { promise->set_value(std::move(job)); });
  return promise->get_future();
}

// The server stops: another start of it will run the job again, as the same attempt.
Move BackToQueue(const Assignment& assignment, v1::Job* job) {
  assignment.record->Take();
  job->set_attempt(job->attempt() - 1);
  return {v1::Job::QUEUED, reason::kServerRestarted};
}

}  // namespace

void JobRunner::Run(Assignment assignment, std::function<void()> ended) {
  v1::Job& job = assignment.job;
  // Asked for before the job is taken, so that it does not wait for that commit.
  auto spec = ReadSpec(store_, job.name());
  LogWriter writer(store_, {job.name(), assignment.epoch, assignment.log}, assignment.stop,
                   shutdown_);
  v1::Event attempt = EventAt(clock_.Now());
  attempt.mutable_attempt_started()->set_attempt(job.attempt());
  writer.Take(job, {assignment.event, attempt});

  const absl::StatusOr<StoredJob> stored = spec.get();
  Move move = Solve(stored, assignment, writer);
  if (move.to == v1::Job::CANCELLED && !*assignment.cancelled) {
    move = BackToQueue(assignment, &job);
    ended = nullptr;
  } else {
    job.MergeFrom(assignment.record->Get(true));
    job.set_server_version(kVersion);
    job.set_server_revision(kRevision);
    if (stored.ok()) job.set_spec_sha256(SpecSha256(stored->job));
  }
  const v1::Event last = Apply(move, clock_.Now(), &job);
  writer.Finish(std::move(job), last, std::move(ended));
}

Move JobRunner::Solve(const absl::StatusOr<StoredJob>& stored, const Assignment& assignment,
                      LogWriter& writer) const {
  if (!stored.ok()) return MoveAfterFault(std::string(stored.status().message()));
  const v1::Job& job = stored->job;
  try {
    if (!job.has_sweep()) return SolveScenario(job.scenario(), assignment, writer);
    return SweepRunner(store_, clock_, options_, assignment, writer).Run(job.sweep());
  } catch (const std::exception& error) {
    return MoveAfterFault(error.what());
  } catch (...) {
    return MoveAfterFault("unknown exception");
  }
}

Move JobRunner::SolveScenario(const v1::Scenario& message, const Assignment& assignment,
                              LogWriter& writer) const {
  const DecodedScenario decoded = DecodeScenario(message, options_.scenario_limits);
  if (decoded.violations.empty()) {
    return MoveAfter(RunScenario(decoded.scenario, assignment, writer));
  }
  const Violation& first = decoded.violations.front();
  return MoveAfterFault("scenario." + first.field + ": " + first.description);
}

Outcome JobRunner::RunScenario(const Scenario& scenario, const Assignment& assignment,
                               LogWriter& writer) const {
  const auto start = std::chrono::steady_clock::now();
  RunRecorder recorder(scenario, clock_, writer, *assignment.log, *assignment.record);
  Outcome outcome = options_.run(scenario, recorder, assignment.stop.get_token());
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  assignment.record->Do([&](v1::Job& job) {
    EncodeOutcome(scenario, outcome, &job);
    job.mutable_summary()->set_wall_time_s(wall.count());
    if (outcome.end != Outcome::End::kFinished) job.clear_convergence();
  });
  return outcome;
}

}  // namespace contact
