#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>

#include "base/clock.h"
#include "jobs/job/job_options.h"
#include "jobs/job/lifecycle.h"
#include "jobs/run/assignment.h"
#include "jobs/run/log_writer.h"
#include "simulation/episode/run_state.h"
#include "storage/store.h"

namespace contact {

class EndingRuns;
class RunRecorder;

/// Runs one job at a time, from its spec in the store to its result on the way there. Of one worker
/// thread; may wait for the store.
class JobRunner {
 public:
  /// All outlive the runner, except that a run that was given up touches none of them any more.
  /// `shutdown` is requested when the server stops.
  JobRunner(Store& store, const Clock& clock, const JobOptions& options, EndingRuns& endings,
            std::stop_token shutdown)
      : store_(store),
        clock_(clock),
        options_(options),
        endings_(endings),
        shutdown_(std::move(shutdown)) {}

  /// Called on the store's thread once the last state of the attempt is committed, or, with false,
  /// once it is found that it cannot be stored.
  using Ended = std::function<void(bool stored)>;
  /// Runs the attempt; does not wait for its end to be stored. `ended` is not called if the run was
  /// given up. The job goes back into the queue if the server stops.
  void Run(Assignment assignment, Ended ended);

 private:
  /// Hands the end of the job over to the store, and waits only while that is far behind.
  void End(v1::Job job, v1::Event last, std::shared_ptr<LogWriter> writer, Ended ended);
  /// Runs the scenario or sweep. A scenario goes on at `from`, if that is a state. An exception
  /// becomes a failure of the job.
  Transition Solve(const StoredJob& spec, const std::optional<RunState>& from,
                   const Assignment& assignment, LogWriter& writer) const;
  /// Decodes the scenario, runs it, and adds advice on its time to the record.
  Transition SolveScenario(const StoredJob& spec, const std::optional<RunState>& from,
                           const Assignment& assignment, LogWriter& writer) const;
  /// Runs the scenario and puts its outcome into the record, with advice on it.
  Outcome RunScenario(const Scenario& scenario, const StoredJob& spec,
                      const std::optional<RunState>& from, const Assignment& assignment,
                      LogWriter& writer) const;
  /// Goes on at `from`, the checkpoint of an earlier attempt, if there is one and its events can be
  /// repeated.
  Outcome RunOrResume(const Scenario& scenario, const StoredJob& spec,
                      const std::optional<RunState>& from, const Assignment& assignment,
                      LogWriter& writer, RunRecorder& recorder) const;

  Store& store_;
  const Clock& clock_;
  /// A copy: a thread that hangs may outlive its manager.
  const JobOptions options_;
  EndingRuns& endings_;
  const std::stop_token shutdown_;
};

}  // namespace contact
