#pragma once

#include <chrono>
#include <condition_variable>
#include <map>
#include <memory>
#include <set>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "base/mutex.h"
#include "jobs/cluster/followed_logs.h"
#include "jobs/cluster/job_claimer.h"
#include "jobs/cluster/shared_options.h"
#include "jobs/log/job_feed.h"
#include "jobs/schedule/unfinished.h"

namespace contact {

/// The unfinished jobs of a store that several processes share. What happens elsewhere comes as
/// notes of the store; because notes may be lost, the store is asked once a second, too.
class SharedJobs final : public Unfinished {
 public:
  /// Begins to listen, and to run jobs if it works. All outlive it. Every change of a job's state
  /// is told to `feed`.
  SharedJobs(SharedStore& store, const Clock& clock, const JobOptions& options,
             const SharedOptions& shared, JobFeed& feed);
  ~SharedJobs() override;

  /// The store does.
  bool counts_in_store() const override { return true; }
  bool Reserve(int /*most*/) override { return true; }
  void Release() override {}
  /// Nothing: the store has the job, and whoever is to run it hears of it from there.
  void Enqueue(v1::Job /*job*/, std::vector<v1::Event> /*events*/,
               std::shared_ptr<const void> /*held*/) override {}
  void Cancel(const std::string& name, const std::string& expected_uid, Done done) override;
  std::shared_ptr<JobLog> Log(const v1::Job& job) override;
  /// Of a job that another process runs, the progress alone.
  std::shared_ptr<const RunRecord> Record(const v1::Job& job) const override;
  /// As it was a second ago.
  Demand demand() const override;
  void CountOf(const JobOwner& whose,
               std::function<void(absl::StatusOr<OwnerCounts>)> done) override;
  void Stop() override;

 private:
  /// How far a run elsewhere is, and when that was told.
  struct Told {
    std::shared_ptr<RunRecord> record = std::make_shared<RunRecord>();
    std::chrono::steady_clock::time_point time = {};
  };

  /// Takes a note, on a thread of the store.
  void Hear(const Note& note);
  void HearProgress(const Note& note);
  /// The loop of the thread that asks the store.
  void Follow(const std::stop_token& stop);
  void Ask();
  /// Waits for notes of logs that are watched. Returns whose logs may be longer; none once it is
  /// time to ask for all.
  std::set<std::string> AwaitMovedLogs(const std::stop_token& stop);
  /// Asks which jobs have changed their state. False: the store does not answer.
  bool AskMoved();
  /// Notes how far all watched jobs are.
  void AskPositions(const std::vector<std::string>& names);
  /// Forgets what was told of runs that nobody tells of any more.
  void ForgetOld();
  /// Stores the end of a cancelled job that has not begun.
  void Withdraw(StoredJob stored, const Done& done);

  SharedStore& store_;
  const Clock& clock_;
  const JobOptions& options_;
  JobFeed& feed_;
  FollowedLogs logs_;
  /// Null: jobs run elsewhere only.
  std::unique_ptr<JobClaimer> claimer_;
  /// MovedJobs::next, of the thread that asks.
  std::uint64_t moved_ = 0;

  mutable Mutex mutex_;
  /// Notified when notes may have been lost, and of notes of logs that are watched.
  std::condition_variable_any missed_;
  bool to_ask_ ABSL_GUARDED_BY(mutex_) = true;
  /// Names of the jobs of these notes.
  std::set<std::string> moved_logs_ ABSL_GUARDED_BY(mutex_);
  Demand demand_ ABSL_GUARDED_BY(mutex_);
  /// By the names of jobs.
  std::map<std::string, Told> told_ ABSL_GUARDED_BY(mutex_);
  std::jthread thread_;  // Last: it uses all of the above.
};

}  // namespace contact
