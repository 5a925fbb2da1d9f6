#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>

#include "jobs/job/budget.h"
#include "jobs/job/job_metrics.h"
#include "simulation/run.h"
#include "wire/scenario/scenario_codec.h"

namespace contact {

/// How much the server keeps of jobs that have ended.
struct RetentionLimits {
  /// Time from the end of a job to its deletion, for jobs without a time to live; 0: no limit.
  std::chrono::seconds age{0};
  /// Bytes that all ended jobs together may take; 0: no limit.
  std::int64_t bytes = 0;
  /// Time from the end of a job until its frame chunks are dropped; 0: they stay with the job.
  std::chrono::seconds compact_after{0};
};

/// How the server treats jobs: what it takes, how long it lets them run, what it keeps of them.
struct JobOptions {
  int workers = 1;               ///< Threads that run simulations, ≥ 1.
  int max_queued_jobs = 10'000;  ///< Past it CreateJob answers QUEUE_FULL.
  int max_watchers = 10'000;     ///< Past it Watch answers WATCHER_LIMIT.
  ScenarioLimits scenario_limits = {};
  RunBudget max_budget = {};  ///< Largest budget of a job; also that of a job that asks for none.
  int max_attempts = 3;       ///< A job that is running whenever the server dies fails then.
  std::chrono::milliseconds step_timeout = std::chrono::minutes(1);  ///< See Watchdog; 0: never.
  std::chrono::milliseconds stop_timeout = std::chrono::seconds(5);  ///< See Watchdog.
  /// Real time between two looks at the running jobs, see Watchdog.
  std::chrono::milliseconds look_interval{50};
  RetentionLimits retention = {};
  /// Least time between two checkpoints of a run; 0: no checkpoints.
  std::chrono::milliseconds checkpoint_interval{0};
  /// Counters of job transitions. Never null.
  std::shared_ptr<JobMetrics> metrics = std::make_shared<JobMetrics>();
  /// Solves a scenario; tests replace it.
  std::function<Outcome(const Scenario&, Observer&, std::stop_token)> run = Run;
  /// Resumes the solution of a scenario from a checkpoint; tests replace it.
  std::function<Outcome(const Scenario&, const RunState&, Observer&, std::stop_token)> resume =
      Resume;
};

}  // namespace contact
