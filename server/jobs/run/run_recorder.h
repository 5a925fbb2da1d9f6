#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "base/clock.h"
#include "jobs/run/assignment.h"
#include "jobs/run/log_writer.h"
#include "simulation/run.h"
#include "wire/chunk_columns.h"
#include "wire/result_advice.h"

namespace contact {

/// Makes events of what a run reports, and hands them to the log writer. Used by the worker's
/// thread.
class RunRecorder final : public Observer {
 public:
  /// Everything outlives the recorder. `checkpoint_interval`: see JobOptions.
  RunRecorder(const Scenario& scenario, const Clock& clock, const Assignment& assignment,
              LogWriter& writer, std::chrono::milliseconds checkpoint_interval)
      : scenario_(scenario),
        clock_(clock),
        assignment_(assignment),
        writer_(writer),
        checkpoint_interval_(checkpoint_interval),
        last_checkpoint_(clock.Elapsed()),
        passings_(scenario) {}

  /// Adds an event to the log, and what the ledger has of it to the record: also for events that an
  /// earlier attempt has recorded.
  void Keep(v1::Event event);

  /// What the samples show of neighbours without a contact between them.
  const Passings& passings() const { return passings_; }

  void OnIteration(const Iteration& iteration) override;
  void OnGrowth(const Group& group) override;
  void OnCycle(const Cycle& cycle) override;
  void OnGroup(const Group& group) override;
  void OnSamples(const Samples& samples) override;
  /// Publishes the progress, at most every 100 ms, and writes events that have waited long enough.
  void OnProgress(const Progress& progress) override;
  void OnWarning(const std::string& warning) override;
  /// Writes what is due and lets others compute if the run is asked to.
  void OnStep() override;
  /// Stores a checkpoint if it is time for one and it is not too large.
  void OnBoundary(const std::function<RunState()>& state) override;

 private:
  /// An event of now, without payload.
  v1::Event Event() const;

  const Scenario& scenario_;
  const Clock& clock_;
  const Assignment& assignment_;
  LogWriter& writer_;
  const std::chrono::milliseconds checkpoint_interval_;
  std::chrono::steady_clock::time_point last_checkpoint_;
  std::chrono::steady_clock::time_point last_progress_ = {};
  Passings passings_;
  /// Of the chunks that Keep takes.
  ColumnJoiner joiner_;
};

}  // namespace contact
