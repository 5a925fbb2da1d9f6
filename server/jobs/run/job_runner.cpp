#include "jobs/run/job_runner.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <optional>
#include <utility>
#include <vector>

#include "jobs/run/ending_runs.h"
#include "jobs/run/replay.h"
#include "jobs/run/run_recorder.h"
#include "jobs/run/run_state_codec.h"
#include "jobs/run/sweep_runner.h"
#include "version.h"
#include "wire/result_advice.h"
#include "wire/result_codec.h"
#include "wire/scenario/scenario_codec.h"
#include "wire/scenario_advice.h"
#include "wire/spec_digest.h"

namespace contact {
namespace {

using Spec = absl::StatusOr<std::shared_ptr<const StoredJob>>;

// The spec at hand, or from the store.
std::future<Spec> ReadSpec(Store& store, const Assignment& assignment) {
  const auto promise = std::make_shared<std::promise<Spec>>();
  if (assignment.spec) {
    promise->set_value(assignment.spec);
  } else {
    store.Read(assignment.job.name(), JobPart::kRun, [promise](absl::StatusOr<StoredJob> stored) {
      if (!stored.ok()) return promise->set_value(stored.status());
      promise->set_value(std::make_shared<const StoredJob>(*std::move(stored)));
    });
  }
  return promise->get_future();
}

Spec AwaitSpec(std::future<Spec> spec, RunControl& control) {
  const RunControl::Hold hold(control);
  return spec.get();
}

// `from`: where the attempt goes on; none: at the start.
v1::Event AttemptStarted(const Clock& clock, const v1::Job& job,
                         const std::optional<RunState>& from) {
  v1::Event event = EventAt(clock.Now());
  event.mutable_attempt_started()->set_attempt(job.attempt());
  if (from) event.mutable_attempt_started()->set_resume_time_s(from->state.time);
  return event;
}

// Where a run goes on: at the checkpoint of an earlier attempt, if there is one.
std::optional<RunState> CheckpointOf(const Spec& spec) {
  return spec.ok() ? DecodeRunState((*spec)->checkpoint) : std::nullopt;
}

// True if the run has not come to an end of its own.
bool Stopped(const Transition& transition, StopCause cause) {
  return transition.to == v1::Job::CANCELLED ||
         (transition.to == v1::Job::SUCCEEDED &&
          (cause == StopCause::kOutput || cause == StopCause::kMemory));
}

// The server stops: another start of it will run the job again, as the same attempt.
Transition BackToQueue(const Assignment& assignment, v1::Job* job) {
  assignment.record->Take();
  job->set_attempt(job->attempt() - 1);
  return {v1::Job::QUEUED, reason::kServerRestarted};
}

}  // namespace

void JobRunner::Run(Assignment assignment, Ended ended) {
  v1::Job& job = assignment.job;
  RunControl& control = *assignment.control;
  // Read before the job is taken: it tells where the attempt begins, and does not wait for a
  // commit.
  const Spec spec = AwaitSpec(ReadSpec(store_, assignment), control);
  const std::optional<RunState> from = CheckpointOf(spec);
  const auto writer = std::make_shared<LogWriter>(
      store_, clock_, LogWriter::Place{job.name(), assignment.epoch, assignment.log},
      assignment.control, shutdown_);
  writer->Take(job, {assignment.event, AttemptStarted(clock_, job, from)});

  Transition transition = spec.ok() ? Solve(**spec, from, assignment, *writer)
                                    : TransitionAfterFault(std::string(spec.status().message()));
  const RunControl::Hold hold(control);
  if (!hold) return;
  const bool stopped = Stopped(transition, control.cause());
  if (stopped && control.cause() == StopCause::kServer) {
    transition = BackToQueue(assignment, &job);
  } else {
    if (stopped) transition = TransitionAfterStop(control.cause(), control.budget());
    assignment.record->Do([&job](const v1::Job& record) { job.MergeFrom(record); });
    job.set_server_version(kVersion);
    job.set_server_revision(kRevision);
    if (spec.ok()) job.set_spec_sha256(SpecSha256((*spec)->job));
  }
  v1::Event last = Apply(transition, clock_.Now(), &job);
  End(std::move(job), std::move(last), writer, std::move(ended));
}

// Hands the end of the job over to the store, and waits only while it is far behind.
void JobRunner::End(v1::Job job, v1::Event last, std::shared_ptr<LogWriter> writer, Ended ended) {
  LogWriter* const key = writer.get();
  const auto stored = [&endings = endings_, metrics = options_.metrics, key,
                       ended = std::move(ended)](const v1::Job* final_job) {
    endings.Remove(key);
    if (final_job != nullptr) metrics->Moved(v1::Job::RUNNING, *final_job);
    ended(final_job != nullptr);
  };
  endings_.Add(std::move(writer), key->pending_bytes() + job.ByteSizeLong());
  if (!key->Finish(std::move(job), std::move(last), stored)) endings_.Remove(key);
  endings_.AwaitRoom(shutdown_);
}

Transition JobRunner::Solve(const StoredJob& spec, const std::optional<RunState>& from,
                            const Assignment& assignment, LogWriter& writer) const {
  try {
    if (!spec.job.has_sweep()) return SolveScenario(spec, from, assignment, writer);
    return SweepRunner(store_, clock_, options_, assignment, writer).Run(spec.job.sweep());
  } catch (...) {
    return TransitionAfterException();
  }
}

Transition JobRunner::SolveScenario(const StoredJob& spec, const std::optional<RunState>& from,
                                    const Assignment& assignment, LogWriter& writer) const {
  DecodedScenario decoded = DecodeScenario(spec.job.scenario(), options_.scenario_limits);
  if (decoded.violations.empty()) {
    const std::vector<Violation> advice = AdviseOnTime(decoded.scenario);
    std::int64_t& max_steps = decoded.scenario.solver.max_steps;
    const std::int64_t budget = assignment.control->budget().steps;
    if (budget > 0) max_steps = std::min(max_steps, budget);
    const Outcome outcome = RunScenario(decoded.scenario, spec, from, assignment, writer);
    assignment.record->Do([&advice](v1::Job& job) {
      for (const Violation& a : advice) job.add_warnings(Text(a));
    });
    return TransitionAfter(outcome);
  }
  const Violation& first = decoded.violations.front();
  return TransitionAfterFault("scenario." + first.field + ": " + first.description);
}

Outcome JobRunner::RunScenario(const Scenario& scenario, const StoredJob& spec,
                               const std::optional<RunState>& from, const Assignment& assignment,
                               LogWriter& writer) const {
  const auto start = clock_.Elapsed();
  RunRecorder recorder(scenario, clock_, assignment, writer, options_.checkpoint_interval);
  Outcome outcome = RunOrResume(scenario, spec, from, assignment, writer, recorder);
  const std::chrono::duration<double> wall = clock_.Elapsed() - start;
  assignment.record->Do([&](v1::Job& job) {
    EncodeOutcome(scenario, outcome, &job);
    job.mutable_summary()->set_wall_time_s(wall.count());
    if (outcome.end != Outcome::End::kFinished) return job.clear_convergence();
    for (const Violation& a : AdviseOnResult(scenario, job, recorder.passings())) {
      job.add_warnings(Text(a));
    }
  });
  return outcome;
}

Outcome JobRunner::RunOrResume(const Scenario& scenario, const StoredJob& spec,
                               const std::optional<RunState>& from, const Assignment& assignment,
                               LogWriter& writer, RunRecorder& recorder) const {
  RunControl& control = *assignment.control;
  const std::string& name = assignment.job.name();
  if (!from) return options_.run(scenario, recorder, control.token());
  if (!Replay(store_, name, spec.checkpoint_sequence, control, recorder)) {
    // What was repeated so far counts for nothing.
    writer.Add(AttemptStarted(clock_, assignment.job, std::nullopt));
    assignment.record->Take();
    return options_.run(scenario, recorder, control.token());
  }
  spdlog::info("job={} goes on from t={} s", name, from->state.time);
  control.CountSteps(from->steps);
  return options_.resume(scenario, *from, recorder, control.token());
}

}  // namespace contact
