#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>

#include "base/ids.h"
#include "base/resident_memory.h"
#include "contact/v1/job_service.pb.h"
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
  /// File that keeps the time by which jobs grow old, see RetentionClock; empty: none.
  std::filesystem::path clock_file = {};
};

/// Most that one owner may have of what all share, see the contract's Quota; 0: any number.
struct OwnerLimits {
  /// Jobs that wait or run.
  std::int64_t unfinished_jobs = 0;
  /// Cells of sweeps that wait or run.
  std::int64_t cells = 0;
  /// Bytes in the store at which no more jobs are accepted.
  std::int64_t stored_bytes = 0;
  /// CreateJob calls, on average and at once.
  double creates_per_second = 0;
  int create_burst = 1000;
  /// Streams, other calls, and connections that are open.
  std::int64_t streams = 0;
  std::int64_t calls = 0;
  std::int64_t connections = 0;
};

/// Space of a disk [byte]; 0: nobody knows.
struct DiskSpace {
  std::int64_t total = 0;
  std::int64_t free = 0;
};

/// How the server treats jobs: what it takes, how long it lets them run, what it keeps of them.
struct JobOptions {
  /// Threads that run simulations, at least 1.
  int workers = 1;
  /// Jobs that may wait for a worker. Past it CreateJob answers QUEUE_FULL.
  int max_queued_jobs = 10'000;
  /// Jobs of one owner that may run at a time; 0: as many as there are workers.
  int max_running_per_owner = 0;
  /// What each owner may have.
  OwnerLimits owner_limits = {};
  /// Of `max_queued_jobs` and `max_watchers`, so many are kept for admins, see OpenTo.
  int admin_slots = 0;
  /// No job is accepted while the disk is fuller [%], see DiskFull; 0: however full it is.
  int max_disk_percent = 0;
  /// The disk of the store.
  std::function<DiskSpace()> disk = [] { return DiskSpace(); };
  /// Streams that may watch jobs or read artifacts. Past it they end with WATCHER_LIMIT.
  int max_watchers = 10'000;
  /// What a scenario or sweep may hold.
  ScenarioLimits scenario_limits = {};
  /// Largest budget of a job; also that of a job that asks for none. While the process takes more
  /// memory than all workers may have by it, no run begins beside another.
  RunBudget max_budget = {};
  /// Memory that the process takes [B]; tests replace it.
  std::function<std::int64_t()> resident = ResidentMemory;
  /// Attempts of a job that is running whenever the server dies; then it fails.
  int max_attempts = 3;
  /// Time without a step after which a run is stopped, see Watchdog; 0: none.
  std::chrono::milliseconds step_timeout = std::chrono::minutes(1);
  /// Time that a run may take to react to a stop before it is given up, see Watchdog.
  std::chrono::milliseconds stop_timeout = std::chrono::seconds(5);
  /// Real time between two looks at the running jobs, see Watchdog.
  std::chrono::milliseconds look_interval{50};
  /// What is kept of ended jobs.
  RetentionLimits retention = {};
  /// Least time between two checkpoints of a run; 0: no checkpoints.
  std::chrono::milliseconds checkpoint_interval{0};
  /// Hides the positions in page tokens, see PageTokens. Processes with the same one, and none
  /// else, read each other's.
  std::string page_secret = RandomIds().NextUuid();
  /// Counters of job transitions. Never null.
  std::shared_ptr<JobMetrics> metrics = std::make_shared<JobMetrics>();
  /// Solves a scenario; tests replace it.
  std::function<Outcome(const Scenario&, Observer&, std::stop_token)> run = Run;
  /// Resumes the solution of a scenario from a checkpoint; tests replace it.
  std::function<Outcome(const Scenario&, const RunState&, Observer&, std::stop_token)> resume =
      Resume;
};

/// The limits of jobs as GetServerInfo tells them. Limits that do not concern jobs are not set.
v1::ServerLimits LimitsOf(const JobOptions& options);

}  // namespace contact
