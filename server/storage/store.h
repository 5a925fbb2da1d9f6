#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "base/clock.h"
#include "storage/backup_file.h"
#include "storage/changes.h"
#include "storage/records.h"
#include "storage/store_metrics.h"

namespace contact {

/// How a store is opened.
struct StoreOptions {
  /// Largest size of the database in bytes; past it writes are RESOURCE_EXHAUSTED. 0: the disk's.
  std::int64_t max_bytes = 0;
  /// Space that is kept for deletions on a full disk, see Reserve.
  std::int64_t reserve_bytes = 0;
  /// Called once, on the store's thread, if the disk fails such that nothing can be promised any
  /// more. The process should end; the store refuses all that follows with UNAVAILABLE.
  std::function<void(const absl::Status&)> on_failure = {};
  /// Where the store counts what it does.
  std::shared_ptr<StoreMetrics> metrics = std::make_shared<StoreMetrics>();
  /// Measures how long commits take. Outlives the store.
  const Clock* clock = &SystemClock();
};

/// What survives a restart: jobs and their event logs. An engine keeps them: one SQLite database of
/// this process, or a PostgreSQL database of many (openers: sqlite/sqlite_store.h,
/// postgres/postgres_store.h). Its destructor finishes what was asked for.
///
/// Calls are thread-safe and return at once. They take effect in the order of the calls; each
/// runs its callback once, on the store's one thread, in that order, after its change is on disk.
/// Callbacks must not block. Errors of every call, beside its own:
///   RESOURCE_EXHAUSTED  no space; nothing was changed; later calls may succeed
///   DATA_LOSS           what it needs is damaged
///   UNAVAILABLE         the disk failed, or the database does not answer
class Store {
 public:
  /// What a call runs once with its answer.
  template <class T>
  using Callback = std::function<void(absl::StatusOr<T>)>;

  Store() = default;
  virtual ~Store() = default;
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  /// Stores a job with the first events of its log and answers its header; or, if `request_id` was
  /// used before to ask for the same, answers all of that job. ALREADY_EXISTS: it was used to ask
  /// for something else. RESOURCE_EXHAUSTED: see NewJob. See JobParts::spec.
  void Create(const NewJob& job, Callback<StoredJob> done);

  /// Changes a job and appends to its log in one transaction. Answers the sequence of the first
  /// event appended; the others are dense. ABORTED: stale epoch, or the job has ended. NOT_FOUND.
  void Update(const JobUpdate& update, Callback<std::uint64_t> done);

  /// An update that is serialised and compressed already.
  using Encoded = std::shared_ptr<const JobChange>;
  /// The first step of an update, on the caller's thread: serialises and compresses.
  static Encoded Encode(const JobUpdate& update);
  /// The second step. Costs little, also on the store's thread, and may be done again after a
  /// failure. `epoch`: see JobUpdate.
  virtual void Update(Encoded change, std::uint64_t epoch, Callback<std::uint64_t> done) = 0;
  /// Takes back an update that the engine has not begun with: it is as if it had never been asked
  /// for. False: it is too late, or the engine never waits for long enough.
  virtual bool Recall(const Encoded& /*change*/) { return false; }

  /// Remembers that a user wants a job cancelled, whoever runs it. NOT_FOUND.
  virtual void RequestCancel(std::string name, Callback<bool> done) = 0;

  /// Replaces labels or note of a job, and answers whose it is. NOT_FOUND. ABORTED, with the
  /// payload kUidPayload: its uid is another.
  virtual void Remark(JobRemark remark, Callback<JobOwner> done) = 0;

  /// Reads a job, or the parts of it that `part` names, for the server itself. NOT_FOUND.
  virtual void Read(std::string name, JobPart part, Callback<StoredJob> done) = 0;
  /// As Read, for a caller of this tenant. NOT_FOUND, also for the job of another tenant.
  virtual void ReadOf(std::string tenant, std::string name, JobPart part,
                      Callback<StoredJob> done) = 0;
  /// Whose the job is, also of a damaged one. NOT_FOUND, also for the job of another tenant.
  virtual void Owner(std::string tenant, std::string name, Callback<JobOwner> done) = 0;
  /// Bytes of events, specs and results of all jobs of the owner.
  virtual void OwnerBytes(JobOwner whose, Callback<std::int64_t> done) = 0;
  /// A page of the jobs that `query` asks for, newest first.
  virtual void List(JobQuery query, Callback<JobPage> done) = 0;
  /// Headers of the jobs that are QUEUED or RUNNING, oldest first.
  virtual void ListUnfinished(Callback<std::vector<StoredJob>> done) = 0;
  /// Sizes of the jobs that have ended, the oldest end first.
  virtual void Sizes(Callback<std::vector<JobSize>> done) = 0;
  /// A page of a job's log. A page may be empty though more follows; go on from its position. Who
  /// asks for a caller has read the job with ReadOf before: names are never used again. NOT_FOUND.
  virtual void ReadEvents(EventQuery query, Callback<EventPage> done) = 0;

  /// Removes a job and its log, and answers whose it was. NOT_FOUND; FAILED_PRECONDITION: it has
  /// not ended. ABORTED, with the payload kUidPayload: its uid is not `expected_uid`, if that is
  /// not empty.
  virtual void Delete(std::string name, std::string expected_uid, Callback<JobOwner> done) = 0;

  /// Drops the frame chunks of a job's log, for ever; see EventPage::oldest. Answers whose the job
  /// is. NOT_FOUND;
  /// FAILED_PRECONDITION: it has not ended.
  virtual void Compact(std::string name, Callback<JobOwner> done) = 0;

  /// Copies the store bit by bit, with other work between, into a file of its own. Everything
  /// that was asked for before is in it, and what is changed meanwhile may be. One backup is made
  /// at a time; others wait. RESOURCE_EXHAUSTED: no space for the copy. CANCELLED: `stop` was
  /// requested, or the store is being closed. FAILED_PRECONDITION: the engine has tools of its own.
  virtual void Backup(std::stop_token stop, Callback<std::unique_ptr<BackupFile>> done) = 0;

  /// Runs `done` after the callbacks of all calls before.
  virtual void Flush(std::function<void()> done) = 0;

 private:
  /// Create, serialised and compressed.
  virtual void Insert(JobInsert job, Callback<StoredJob> done) = 0;
};

}  // namespace contact
