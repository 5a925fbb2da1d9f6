#include "jobs/job_runner.h"

#include <algorithm>
#include <chrono>
#include <future>
#include <utility>
#include <vector>

#include "jobs/run_recorder.h"
#include "jobs/sweep_runner.h"
#include "version.h"
#include "wire/result_codec.h"
#include "wire/scenario_codec.h"

namespace contact {
namespace {

std::future<absl::StatusOr<StoredJob>> ReadSpec(Store& store, const std::string& name) {
  const auto promise = std::make_shared<std::promise<absl::StatusOr<StoredJob>>>();
  store.Read(name, JobPart::kSpec,
             [promise](absl::StatusOr<StoredJob> job) { promise->set_value(std::move(job)); });
  return promise->get_future();
}

absl::StatusOr<StoredJob> Await(std::future<absl::StatusOr<StoredJob>> job, RunControl& control) {
  const RunControl::Report report(control);
  return job.get();
}

// True if the run has not come to an end of its own.
bool Stopped(const Move& move, StopCause cause) {
  return move.to == v1::Job::CANCELLED ||
         (move.to == v1::Job::SUCCEEDED && cause == StopCause::kOutput);
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
  RunControl& control = *assignment.control;
  // Asked for before the job is taken, so that it does not wait for that commit.
  auto spec = ReadSpec(store_, job.name());
  LogWriter writer(store_, {job.name(), assignment.epoch, assignment.log}, control, shutdown_);
  v1::Event attempt = EventAt(clock_.Now());
  attempt.mutable_attempt_started()->set_attempt(job.attempt());
  writer.Take(job, {assignment.event, attempt});

  Move move = Solve(Await(std::move(spec), control), assignment, writer);
  if (control.given_up()) return;
  const bool stopped = Stopped(move, control.cause());
  if (stopped && control.cause() == StopCause::kServer) {
    move = BackToQueue(assignment, &job);
    ended = nullptr;
  } else {
    if (stopped) move = MoveAfterStop(control.cause(), control.budget());
    job.MergeFrom(assignment.record->Get(true));
    job.set_server_version(kVersion);
  }
  const v1::Event last = Apply(move, clock_.Now(), &job);
  options_.metrics->Moved(v1::Job::RUNNING, job);
  writer.Finish(std::move(job), last, std::move(ended));
}

Move JobRunner::Solve(const absl::StatusOr<StoredJob>& stored, const Assignment& assignment,
                      LogWriter& writer) const {
  if (!stored.ok()) return MoveAfterFault(std::string(stored.status().message()));
  const v1::Job& job = stored->job;
  try {
    if (!job.has_sweep()) return SolveScenario(job.scenario(), assignment, writer);
    return SweepRunner(store_, clock_, options_, assignment, writer).Run(job.sweep());
  } catch (...) {
    return MoveAfterException();
  }
}

Move JobRunner::SolveScenario(const v1::Scenario& message, const Assignment& assignment,
                              LogWriter& writer) const {
  DecodedScenario decoded = DecodeScenario(message, options_.scenario_limits);
  if (decoded.violations.empty()) {
    std::int64_t& max_steps = decoded.scenario.solver.max_steps;
    const std::int64_t budget = assignment.control->budget().steps;
    if (budget > 0) max_steps = std::min(max_steps, budget);
    return MoveAfter(RunScenario(decoded.scenario, assignment, writer));
  }
  const Violation& first = decoded.violations.front();
  return MoveAfterFault("scenario." + first.field + ": " + first.description);
}

Outcome JobRunner::RunScenario(const Scenario& scenario, const Assignment& assignment,
                               LogWriter& writer) const {
  const auto start = std::chrono::steady_clock::now();
  RunControl& control = *assignment.control;
  RunRecorder recorder(scenario, clock_, control, writer, *assignment.log, *assignment.record);
  Outcome outcome;
  try {
    outcome = options_.run(scenario, recorder, control.token());
  } catch (const RunStopped&) {
    outcome.end = Outcome::End::kStopped;
    return outcome;
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  assignment.record->Do([&](v1::Job& job) {
    EncodeOutcome(scenario, outcome, &job);
    job.mutable_summary()->set_wall_time_s(wall.count());
    if (outcome.end != Outcome::End::kFinished) job.clear_convergence();
  });
  return outcome;
}

}  // namespace contact
