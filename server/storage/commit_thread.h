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
  struct Operation {
    /// Runs inside the transaction. Runs again if an operation beside it made that fail.
    std::function<void(Database&)> run;
    /// Runs once, after the commit or with the reason why there is none.
    std::function<void(const absl::Status&)> done;
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
  /// Commits what was posted, then joins.
  ~CommitThread();

  /// Thread-safe; returns at once. Operations run in the order of their posting.
  void Post(Operation operation);
  /// The same; tasks run one after the other.
  void Post(Task task);

 private:
  using Batch = std::vector<Operation>;

  void Loop();
  std::optional<Batch> NextBatch();
  void Commit(Batch& batch);
  void Count(std::chrono::steady_clock::time_point begin, std::size_t operations,
             const absl::Status& status);
  absl::Status Try(const std::function<void()>& work);
  void Tidy();
  void StepTask();
  void EndTask(const absl::Status& status);
  void CancelTasks();
  void Checkpoint();
  void Fail(const absl::Status& failure);

  const std::unique_ptr<Database> database_;  // Of the thread.
  const std::function<bool(Database&)> tidy_;
  const std::function<void(const absl::Status&)> on_failure_;
  const std::shared_ptr<StoreMetrics> metrics_;
  const Clock& clock_;
  bool untidy_ = true;        // Of the thread: `tidy_` may have something to do.
  absl::Status failure_;      // Of the thread.
  std::optional<Task> task_;  // Of the thread: the one under way.

  Mutex mutex_;
  std::condition_variable_any posted_;
  Batch queue_ ABSL_GUARDED_BY(mutex_);
  std::deque<Task> tasks_ ABSL_GUARDED_BY(mutex_);
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;
  std::thread thread_;  // Last: it uses all of the above.
};

}  // namespace contact
