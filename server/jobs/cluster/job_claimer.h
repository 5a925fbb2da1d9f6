#pragma once

#include <chrono>
#include <condition_variable>
#include <map>
#include <set>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "base/mutex.h"
#include "jobs/cluster/shared_options.h"
#include "jobs/cluster/sweep_borrower.h"
#include "jobs/cluster/sweep_lender.h"
#include "jobs/log/job_feed.h"
#include "jobs/quota/quotas.h"
#include "jobs/schedule/scheduler.h"

namespace contact {

/// Gets jobs of a shared store for the threads of this process: claims as many as it can begin
/// soon, says that it lives for as long as it does, gives up what others have taken over, and
/// settles what dead workers have left. Thread-safe.
class JobClaimer {
 public:
  /// Starts the threads. All outlive it.
  JobClaimer(SharedStore& store, const Clock& clock, const JobOptions& options,
             const SharedOptions& shared, JobFeed& feed);
  ~JobClaimer();

  /// Jobs wait, perhaps.
  void JobsWait();
  /// Cells of sweeps wait, perhaps.
  void LoansWait();
  /// How much there is to do in all processes.
  void SetDemand(const Demand& demand);
  /// Somebody wants the job cancelled, perhaps: cancels it if it is here and the store says so.
  void LookForCancel(const std::string& name);
  /// Runs the jobs that this process has.
  const Scheduler& scheduler() const { return scheduler_; }
  /// Hands the jobs back, and says that the worker is gone. Idempotent.
  void Stop();

 private:
  using Time = std::chrono::steady_clock::time_point;
  using Jobs = std::vector<Scheduler::Here>;

  /// The loop of the thread.
  void Loop(const std::stop_token& stop);
  /// Says that the worker lives, if it is time.
  void BeatIfDue(Time now, const Jobs& jobs);
  /// Compares what the store says that this process has with what it had when it asked.
  void Compare(const std::set<std::string>& had, const std::vector<HeldJob>& held);
  void Cancel(const std::string& name);
  /// Takes in a job of which the store says that this process has it.
  void Adopt(const HeldJob& held);
  /// Claims what can be begun soon, if there may be some.
  void ClaimIfUseful(Time now, const Jobs& jobs);
  void Claim(const JobClaim& claim);
  /// Takes in what was claimed.
  void TakeIn(StoredJob stored);
  /// Counts worker time, tells how far the runs are, and finds out whether the process is idle.
  void Look(Time now, const Jobs& jobs);
  void TellProgress(Time now, const Jobs& jobs);
  /// There is something to do.
  void Wake();
  /// Threads of other processes that have nothing to do.
  int IdleElsewhere(const Jobs& jobs) const;
  /// Jobs more that this process could begin soon; 0: too few to ask for them. Notes how many may
  /// leave until there are enough.
  int Wanted(const Jobs& jobs);
  /// A job has left the scheduler.
  void Left();
  /// True if jobs are to be claimed now.
  bool hungry() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return jobs_wait_ && !claiming_ && enough_ <= 0;
  }

  SharedStore& store_;
  const Clock& clock_;
  const JobOptions& options_;
  const SharedOptions& shared_;
  const WorkerProcess process_;
  /// Jobs count in the store.
  Quotas quotas_;

  // Of the thread.
  Time last_beat_ = {};
  Time last_claim_ = {};
  Time last_look_ = {};
  Time last_progress_ = {};
  /// Since when all threads are busy.
  Time busy_since_ = {};
  /// When there was a job last.
  Time last_busy_ = {};
  /// Progress that was told, serialised, by job.
  std::map<std::string, std::string> told_;
  /// Worker time since the last claim, by tenant and owner.
  std::map<std::pair<std::string, std::string>, std::chrono::milliseconds> used_;
  bool left_ = false;

  // Of the store's thread.
  /// Jobs that the store says this process has, and it has not; they may be on their way.
  std::set<std::string> strays_;

  mutable Mutex mutex_;
  /// Notified when there is something to do.
  std::condition_variable_any changed_;
  bool jobs_wait_ ABSL_GUARDED_BY(mutex_) = true;
  bool woken_ ABSL_GUARDED_BY(mutex_) = false;
  Demand demand_ ABSL_GUARDED_BY(mutex_);
  bool claiming_ ABSL_GUARDED_BY(mutex_) = false;
  bool beating_ ABSL_GUARDED_BY(mutex_) = false;
  /// Jobs that have left of late; it counts half each tenth of a second later.
  double rate_ ABSL_GUARDED_BY(mutex_) = 0;
  /// Jobs that may leave before it is worth to claim more.
  int enough_ ABSL_GUARDED_BY(mutex_) = 0;

  Scheduler scheduler_;
  SweepLender lender_;
  SweepBorrower borrower_;
  std::jthread thread_;  // Last: it uses all of the above.
};

}  // namespace contact
