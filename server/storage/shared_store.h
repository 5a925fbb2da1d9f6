#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "storage/store.h"

namespace contact {

/// A process that runs jobs of a shared store.
struct WorkerProcess {
  /// Nobody else's, ever.
  std::string name;
  /// Where it runs, for people.
  std::string host;
  /// Simulations that it runs at once.
  int threads = 1;
  /// What a batch system calls it; empty: nothing.
  std::string batch_id = {};
  /// It loses its jobs when it was not heard of for so long.
  std::chrono::milliseconds lease{10'000};
};

/// What a worker asks for.
struct JobClaim {
  /// WorkerProcess::name.
  std::string worker;
  /// Waiting jobs that it can take.
  int most = 0;
  /// Jobs of one owner that may run at a time, in all processes; 0: any number.
  int most_running = 0;
  /// After a start of the database workers have so long to come back before they lose their jobs.
  std::chrono::milliseconds grace{0};
  /// Specs of at most so many bytes come with their jobs.
  std::int64_t spec_bytes = 64 << 10;
  /// Whose jobs it does not want.
  std::vector<JobOwner> none_of = {};
  /// Worker time used since the last claim, by owner.
  struct Used {
    JobOwner whose;
    std::chrono::milliseconds time;
  };
  std::vector<Used> used = {};
};

/// A job that a worker has.
struct HeldJob {
  std::string name;
  std::uint64_t epoch = 0;
  /// See Store::RequestCancel.
  bool cancel_requested = false;
};

/// How much there is to do, and who does it.
struct Demand {
  /// Jobs that no worker has.
  std::int64_t queued = 0;
  /// Jobs that a worker has.
  std::int64_t running = 0;
  /// Processes that live, and their threads.
  std::int64_t workers = 0;
  std::int64_t threads = 0;
  /// Cells of sweeps that run, which several workers can compute.
  std::int64_t cells = 0;
};

/// Cells of a running sweep that its worker lets another one compute.
struct Loan {
  /// Name and epoch of the sweep's job.
  std::string job;
  std::uint64_t epoch = 0;
  /// Tells it from the other loans of the same epoch.
  std::int64_t number = 0;
  /// First and last cell.
  std::int32_t first = 0;
  std::int32_t last = 0;
};

/// What came of a loan's cells.
struct LoanCounts {
  std::int32_t failed = 0;
  std::int32_t not_converged = 0;
  /// Integration steps.
  std::int64_t steps = 0;
};

/// A loan that has come to an end.
struct LoanEnd {
  std::int64_t number = 0;
  /// The cells are in the sweep's log; false: nobody computes them.
  bool done = false;
  LoanCounts counts = {};
};

/// What of its limits an owner has.
struct OwnerCounts {
  std::int64_t jobs = 0;
  std::int64_t cells = 0;
  std::int64_t running = 0;
};

/// How far the log of a job is.
struct LogPosition {
  std::string name;
  std::uint64_t last_sequence = 0;
  /// The log ends there.
  bool ended = false;
};

/// Jobs that have changed their states, labels or notes.
struct MovedJobs {
  struct Job {
    std::string name;
    std::string tenant;
  };
  std::vector<Job> jobs;
  /// To ask with next.
  std::uint64_t next = 0;
};

/// What one process tells all others. It may be lost, and whoever may connect to a database can
/// make one up: it says only where to look, but for progress.
struct Note {
  enum class Kind {
    /// The job was created, changed or deleted: `tenant`, `last_sequence`, `state`.
    kChanged = 1,
    /// Somebody wants the job cancelled.
    kCancel = 2,
    /// How far the run of the job is: `progress`.
    kProgress = 3,
    /// Cells of the sweep wait for a worker.
    kLoans = 4,
  };
  Kind kind = Kind::kChanged;
  std::string name;
  std::string tenant = {};
  std::uint64_t last_sequence = 0;
  /// The v1::Job::State that it has entered; 0: as before.
  int state = 0;
  /// A serialised v1::Progress.
  std::string progress = {};
};

/// A store that many processes use at a time: who has which job, and what changes elsewhere. Calls
/// are as those of Store.
class SharedStore : public Store {
 public:
  /// Says that the worker lives, and answers the jobs that it has. The first call makes it known.
  virtual void Beat(const WorkerProcess& worker, Callback<std::vector<HeldJob>> done) = 0;
  /// Gives the worker jobs, with a new epoch: those whose worker is dead, in the state in which
  /// that has left them; and QUEUED ones, by priority and fair among owners. With a job comes its
  /// checkpoint, and its spec unless that is too large or damaged. No job if the worker is not
  /// known or was not heard of for its lease.
  virtual void Claim(const JobClaim& claim, Callback<std::vector<StoredJob>> done) = 0;
  /// The worker ends: what it has and has not begun waits for another.
  virtual void Leave(const std::string& worker, Callback<bool> done) = 0;

  /// Lends cells of sweeps that the worker runs. Of a loan `job`, `number` and the cells count.
  virtual void Lend(const std::string& worker, const std::string& job,
                    const std::vector<Loan>& loans, Callback<bool> done) = 0;
  /// Which of the loans with these numbers have ended. Those of dead workers have; `back`: those
  /// that nobody has taken, too.
  virtual void SettleLoans(const std::string& worker, const std::string& job,
                           const std::vector<std::int64_t>& numbers, bool back,
                           Callback<std::vector<LoanEnd>> done) = 0;
  /// Takes a loan of any sweep; a worker has one at a time. Nothing: there is none.
  virtual void TakeLoan(const std::string& worker, Callback<std::optional<Loan>> done) = 0;
  /// Appends the cells of a loan, as events, to the log of its sweep. ABORTED: they are not wanted
  /// any more.
  virtual void ReturnLoan(const std::string& worker, const Loan& loan, const LoanCounts& counts,
                          absl::Span<const v1::Event> events, Callback<std::uint64_t> done) = 0;
  /// Gives a loan back as it was.
  virtual void RefuseLoan(const std::string& worker, const Loan& loan, Callback<bool> done) = 0;

  virtual void Count(Callback<Demand> done) = 0;
  virtual void CountOf(const JobOwner& whose, Callback<OwnerCounts> done) = 0;
  /// Positions of those of the jobs that are there.
  virtual void Positions(const std::vector<std::string>& names,
                         Callback<std::vector<LogPosition>> done) = 0;
  /// Jobs that have moved since the answer with this `next`; some of them were in that answer, too.
  /// 0: none, only where to begin.
  virtual void Moved(std::uint64_t since, Callback<MovedJobs> done) = 0;

  /// Keeps a short value under a name for all processes; one that is there already stays unless
  /// `replace`. Answers what is kept then.
  virtual void Keep(const std::string& name, const std::string& value, bool replace,
                    Callback<std::string> done) = 0;

  /// Hears the notes of all processes, also of this one; on a thread of the store. `missed`: notes
  /// may have been lost before now; called at the start, too.
  virtual void Listen(std::function<void(const Note&)> heard, std::function<void()> missed) = 0;
  /// Ends that. Neither of the two is called any more.
  virtual void Unlisten() = 0;
  /// Tells all processes, soon; what is told of the same job meanwhile becomes one note. What the
  /// other calls change is told by itself.
  virtual void Tell(const Note& note) = 0;
};

}  // namespace contact
