#pragma once

#include <absl/status/status.h>

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "jobs/log/job_feed.h"
#include "jobs/quota/quotas.h"
#include "jobs/run/ending_runs.h"
#include "jobs/run/job_runner.h"
#include "jobs/run/sweep_run.h"
#include "jobs/schedule/memory_watch.h"
#include "jobs/schedule/run_supervisor.h"
#include "jobs/schedule/spec_cache.h"
#include "jobs/schedule/sweep_offers.h"
#include "jobs/schedule/turns.h"
#include "jobs/schedule/unfinished.h"
#include "jobs/schedule/worker_pool.h"

namespace contact {

/// Decides when a job runs: knows the jobs that have not ended, gives each its turn, has the worker
/// threads and watches over them. A worker without a job helps with a sweep. Thread-safe.
///
/// A run that yields keeps its thread and waits in it. So there are as many threads as workers, one
/// more for each such run, and at least one that waits for a job while something waits for its
/// turn.
///
/// A job that was running each time the server died, and has one attempt left, never runs together
/// with another such one: so each next death tells which of them is to blame.
///
/// Jobs enter and leave it on the store's thread, in the order of their commits; so in a callback
/// of the store a job is known here just if the store says that it has not ended.
class Scheduler final : public Unfinished {
 public:
  /// Every change of a job's state is told to `feed`. `left` is called each time a job has left the
  /// scheduler.
  Scheduler(
      Store& store, const Clock& clock, const JobOptions& options, JobFeed& feed, Quotas& quotas,
      std::function<void()> left = [] {});
  ~Scheduler() override;

  /// Queues the jobs that an earlier process left unfinished, or ends them; waits until that is
  /// done. They count in the quotas. For a process that alone has the store.
  void Recover();
  /// Starts the workers. Called once.
  void Start();
  /// Queues a job of the store. On the store's thread.
  void Take(StoredJob stored);
  /// Moves a job that was running when its worker died into its next state, in the store; it does
  /// not come here. On the store's thread.
  void Settle(StoredJob stored);
  /// Another worker has the job now: its run is stopped, and nothing more is stored of it.
  void Lose(const std::string& name);

  bool counts_in_store() const override { return false; }
  bool Reserve(int most) override;
  void Release() override;
  void Enqueue(v1::Job job, std::vector<v1::Event> events,
               std::shared_ptr<const void> held) override;
  void Cancel(const std::string& name, const std::string& expected_uid, Done done) override;
  std::shared_ptr<JobLog> Log(const v1::Job& job) override;
  std::shared_ptr<const RunRecord> Record(const v1::Job& job) const override;
  /// `running`: those that a worker runs, or whose end is being stored.
  Demand demand() const override;
  void CountOf(const JobOwner& whose,
               std::function<void(absl::StatusOr<OwnerCounts>)> done) override;
  /// Puts running jobs back into the queue, in the store, and joins the workers.
  void Stop() override;

  /// A job that is here.
  struct Here {
    std::string name;
    JobOwner whose;
    /// It has a thread.
    bool running = false;
    /// Its run has ended, and its end is being stored.
    bool ending = false;
    v1::Progress progress = {};
  };
  std::vector<Here> jobs() const;

  /// A sweep that runs here.
  struct OwnSweep {
    std::string job;
    std::shared_ptr<SweepRun> run;
  };
  std::vector<OwnSweep> sweeps() const;
  /// Has idle workers help with cells of a sweep that runs elsewhere.
  void Help(const std::shared_ptr<SweepRun>& sweep) { Offer(sweep); }
  /// Threads that neither run a job nor help.
  int idle() const;

 private:
  /// A job that has not ended.
  struct Active {
    /// Header.
    v1::Job job;
    /// Of the stored job.
    std::uint64_t epoch = 0;
    /// Counts the jobs in the order in which they came.
    std::uint64_t number = 0;
    std::shared_ptr<JobLog> log;
    std::shared_ptr<RunRecord> record = std::make_shared<RunRecord>();
    /// What of its owner's limits it takes.
    std::shared_ptr<const void> held;
    /// Null until a worker has the job.
    std::shared_ptr<RunControl> control;
    /// Of a job that is a sweep and runs.
    std::weak_ptr<SweepRun> sweep = {};
    /// Another worker has the job, in another process.
    bool lost = false;
    /// The run has ended.
    bool ending = false;
    /// The run has ended, and its end could not be stored.
    bool unstored = false;
  };
  /// An unfinished job of the store.
  Active ToActive(StoredJob stored);
  /// As Settle. The job in its next state.
  v1::Job Settle(const Active& active, bool cancel_requested);
  /// A log in memory whose changes of state are told to feed_.
  std::shared_ptr<JobLog> NewLog(const v1::Job& job, std::uint64_t last);
  /// Takes in a job that waits for a worker.
  void Add(Active active) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void Queue(const Active& active) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  /// The job as its turn has it.
  Turns::Job TurnOf(const Active& active) const;
  /// Moves a job that no worker has into its next state: in the store, then in its log. `take`
  /// raises the epoch, so that a lost worker can store nothing more. `stored` is called on the
  /// store's thread. Returns the job in its next state.
  v1::Job Commit(Active active, const Transition& transition, bool take, Done stored);
  /// The loop of a worker thread.
  void Work(Worker& worker);
  /// What a worker does next: a job, or help; neither when it is time to stop.
  struct Task {
    std::optional<Assignment> job;
    std::shared_ptr<SweepRun> sweep;
    /// Name of the job.
    std::string name = {};
  };
  /// Waits for a task.
  Task Next(Worker& worker);
  /// The calling thread has ended its task.
  void EndTask(const Task& task) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  /// What a helper knows of jobs that need a worker.
  struct Look {
    /// When it looked last [s].
    double last = 0;
    /// Since when there is one [s].
    std::optional<double> since = {};
  };
  /// Looks. True if one has waited for too long, so that the helper is to leave its cell.
  bool IsWanted(Look* look) const;
  /// Looks at the memory of the process, and asks a run to yield if others have waited for too
  /// long.
  void Balance();
  /// Has the calling worker wait while it is another's turn.
  void Yield(const std::string& name, RunControl& control);
  /// True if a job runs on its last attempt, see the class comment.
  bool careful() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  /// Seconds of the monotonic clock.
  double Now() const;
  /// Hands a queued job to the calling worker: it is RUNNING from here on.
  Assignment Assign(Active& active) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  /// Lets idle workers help with a sweep.
  void Offer(const std::shared_ptr<SweepRun>& sweep);
  /// Frees what a job holds of its owner's quotas: who sees the end may create the next.
  void FreeQuota(const std::string& name);
  /// Forgets a job that has ended.
  void Remove(const std::string& name);
  /// True if a job whose end could not be stored is still ours to end.
  bool IsToEnd(const std::string& name);
  /// Stores the end of a cancelled job that was taken from the queue.
  void Withdraw(const Active& active, Done done);
  /// Replaces the workers of a run that was given up, and ends its job.
  void FailLostRun(const std::string& name, const RunControl& run);

  Store& store_;
  const Clock& clock_;
  const JobOptions& options_;
  JobFeed& feed_;
  Quotas& quotas_;
  const std::function<void()> left_;
  std::stop_source shutdown_;

  mutable Mutex mutex_;
  /// Notified when the queue or the sweeps have changed, and at the end.
  std::condition_variable_any changed_;
  /// By the names of the jobs.
  std::map<std::string, Active> active_ ABSL_GUARDED_BY(mutex_);
  Turns turns_ ABSL_GUARDED_BY(mutex_);
  /// While it is crowded no run begins beside another.
  MemoryWatch memory_ ABSL_GUARDED_BY(mutex_);
  /// Threads that wait in Next, or will soon.
  int idle_ ABSL_GUARDED_BY(mutex_) = 0;
  /// Specs and checkpoints of jobs in the queue.
  SpecCache specs_ ABSL_GUARDED_BY(mutex_);
  /// Number of the newest job.
  std::uint64_t numbers_ ABSL_GUARDED_BY(mutex_) = 0;
  /// Jobs that a worker runs, by name; true: on the last attempt, see the class comment.
  std::map<std::string, bool> running_ ABSL_GUARDED_BY(mutex_);
  SweepOffers sweeps_ ABSL_GUARDED_BY(mutex_);
  /// Places in the queue that are kept.
  int reserved_ ABSL_GUARDED_BY(mutex_) = 0;
  EndingRuns endings_;
  // Last: they use all of the above.
  WorkerPool workers_;
  RunSupervisor supervisor_;
};

}  // namespace contact
