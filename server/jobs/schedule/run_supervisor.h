#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "base/mutex.h"
#include "jobs/job/job_options.h"
#include "jobs/run/ending_runs.h"
#include "jobs/run/run_control.h"
#include "jobs/schedule/watchdog.h"

namespace contact {

/// Watches over all runs from a thread of its own, named `watchdog`: stops those that stall or are
/// out of time, and gives up those that do not react. Thread-safe.
class RunSupervisor {
 public:
  /// Called on the thread, once a run was given up, with the name of its job.
  using Lost = std::function<void(const std::string& job, const RunControl& run)>;

  /// Starts the thread. At each look it also has `endings` try again and calls `look`. Clock,
  /// options and endings outlive the supervisor.
  RunSupervisor(
      const Clock& clock, const JobOptions& options, EndingRuns& endings, Lost lost,
      std::function<void()> look = [] {});

  /// A run begins. It is watched until it is removed or given up.
  void Add(const std::string& job, std::shared_ptr<RunControl> run);
  /// A run has ended, and its end is stored. It is not given up from now on.
  void Remove(const std::string& job);
  /// Ends the thread, after calls of `lost` that have begun. Idempotent; by one thread.
  void Stop();

 private:
  struct Run {
    std::shared_ptr<RunControl> control;
    Watchdog watchdog;
  };
  using Runs = std::vector<std::pair<std::string, std::shared_ptr<RunControl>>>;

  /// Body of the thread.
  void Loop(const std::stop_token& stop);
  /// Waits until there is something to look at, and looks at all runs. Returns those that it has
  /// given up.
  Runs Look(const std::stop_token& stop);

  const Clock& clock_;
  const JobOptions& options_;
  EndingRuns& endings_;
  const Lost lost_;
  const std::function<void()> look_;

  Mutex mutex_;
  /// Notified when there is a run where none was.
  std::condition_variable_any added_;
  /// By the names of their jobs.
  std::map<std::string, Run> runs_ ABSL_GUARDED_BY(mutex_);
  std::jthread thread_;  // Last: it uses all of the above.
};

}  // namespace contact
