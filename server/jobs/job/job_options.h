#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>

#include "jobs/job/budget.h"
#include "jobs/job/job_metrics.h"
#include "simulation/run.h"
#include "wire/scenario_codec.h"

namespace contact {

/// How much the server keeps of jobs that have ended.
struct RetentionLimits {
  std::chrono::seconds age{0};  ///< Since the end, of jobs that do not say so themselves; 0: any.
  std::int64_t bytes = 0;       ///< Of all ended jobs together; 0: any.
  /// Since the end, until the frame chunks of a job are dropped; 0: they are kept as long as it.
  std::chrono::seconds compact_after{0};
};

/// How the server treats jobs: what it takes, how long it lets them run, what it keeps of them.
struct JobOptions {
  int workers = 1;               ///< Threads that run simulations, ≥ 1.
  int max_queued_jobs = 10'000;  ///< Past it CreateJob answers QUEUE_FULL.
  int max_watchers = 10'000;     ///< Past it Watch answers WATCHER_LIMIT.
  ScenarioLimits scenario_limits = {};
  RunBudget max_budget = {};  ///< Of a job, and of one that asks for none.
  int max_attempts = 3;       ///< A job that is running whenever the server dies fails then.
  std::chrono::milliseconds step_timeout = std::chrono::minutes(1);  ///< See Watchdog; 0: never.
  std::chrono::milliseconds stop_timeout = std::chrono::seconds(5);  ///< See Watchdog.
  /// Real time between two looks at the running jobs, see Watchdog.
  std::chrono::milliseconds look_interval{50};
  RetentionLimits retention = {};
  /// Between the checkpoints of a run, at least; 0: none.
  std::chrono::milliseconds checkpoint_interval{0};
  /// Where what becomes of jobs is counted.
  std::shared_ptr<JobMetrics> metrics = std::make_shared<JobMetrics>();
  /// What solves a scenario; tests put something else here.
  std::function<Outcome(const Scenario&, Observer&, std::stop_token)> run = Run;
  /// The same from a checkpoint on.
  std::function<Outcome(const Scenario&, const RunState&, Observer&, std::stop_token)> resume =
      Resume;
};

}  // namespace contact
