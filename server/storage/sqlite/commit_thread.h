#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "base/mutex.h"
#include "storage/store_metrics.h"

namespace contact {

class Database;

/// The one thread that uses the database. Operations posted while it commits go together into the
/// next transaction, so that one sync of the disk serves them all; one that comes alone does not
/// wait for others.
class CommitThread {
 public:
  /// A change or a question, of which many share a transaction.
  struct Operation {
    /// Runs inside the transaction. Runs again if an operation beside it made that fail.
    std::function<void(Database&)> run;
    /// Runs once, after the commit or with the reason why there is none.
    std::function<void(const absl::Status&)> done;
    /// True: it frees space, and may use the reserve where there is none.
    bool frees = false;
  };

  /// Work that takes too long for a transaction.
  struct Task {
    /// Runs outside of transactions, between two batches, again and again until it answers false
    /// or an error. An SQLite::Exception is an error of the task, not of the store.
    std::function<absl::StatusOr<bool>(Database&)> step;
    /// Runs once, after the last step. CANCELLED: the thread ends.
    std::function<void(const absl::Status&)> done;
  };

  /// `tidy` is run in a transaction of its own after each batch, and again while there is nothing
  /// else to do, until it returns false. `on_failure` is called once, on the thread, when the disk
  /// fails in a way that leaves open what it holds. From then on no operation runs.
  CommitThread(std::unique_ptr<Database> database, std::function<bool(Database&)> tidy,
               std::function<void(const absl::Status&)> on_failure,
               std::shared_ptr<StoreMetrics> metrics, const Clock& clock);
  /// Commits what was posted, cancels the tasks, then joins.
  ~CommitThread();

  /// Thread-safe; returns at once. Operations run in the order of their posting.
  void Post(Operation operation);
  /// Thread-safe; returns at once. Tasks run one after the other, in the order of their posting.
  void Post(Task task);

 private:
  using Batch = std::vector<Operation>;

  // All private methods run on the thread.
  void Loop();
  // Waits for operations. Empty: the database is to be tidied or checkpointed, or a task goes on.
  // None at all: it is time to stop.
  std::optional<Batch> NextBatch();
  // Commits a batch as one transaction, or its operations one by one if that fails, and tells them.
  void Commit(Batch& batch);
  // Counts a transaction of `operations` that began at `begin`.
  void Count(std::chrono::steady_clock::time_point begin, std::size_t operations,
             const absl::Status& status);
  // Does `work` in a transaction; on error nothing is done.
  absl::Status Try(const std::function<void()>& work);
  // Try for work that frees space: on a full disk once more, with the reserve.
  absl::Status TryFreeing(const std::function<void()>& work);
  // Runs `tidy_`. What fails is tried again after the next batch.
  void Tidy();
  // Runs a step of the task under way, and ends the task after the last one.
  void StepTask();
  // Ends the task under way and tells it why.
  void EndTask(const absl::Status& status);
  // Ends the task under way and those that wait.
  void CancelTasks();
  // Folds the write-ahead log into the database file.
  void Checkpoint();
  // Refuses everything from now on.
  void Fail(const absl::Status& failure);

  // Used by the thread alone, as all members up to `mutex_`.
  const std::unique_ptr<Database> database_;
  const std::function<bool(Database&)> tidy_;
  const std::function<void(const absl::Status&)> on_failure_;
  const std::shared_ptr<StoreMetrics> metrics_;
  const Clock& clock_;
  // True while `tidy_` may have something to do.
  bool untidy_ = true;
  // Why everything is refused; OK: nothing is.
  absl::Status failure_;
  // The task under way.
  std::optional<Task> task_;

  Mutex mutex_;
  std::condition_variable_any posted_;
  Batch queue_ ABSL_GUARDED_BY(mutex_);
  std::deque<Task> tasks_ ABSL_GUARDED_BY(mutex_);
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;
  // Last, because it uses all of the above.
  std::thread thread_;
};

}  // namespace contact
