#include "storage/sqlite/commit_thread.h"

#include <pthread.h>

#include <chrono>
#include <iterator>
#include <utility>

#include "storage/sqlite/database.h"

namespace contact {
namespace {

// Bounds how long an operation waits for those before it in the same transaction.
constexpr std::size_t kMaxBatch = 256;
// Bounds the write-ahead log, and with it the time of a checkpoint: 4 MiB.
constexpr int kMaxLogPages = 1024;
constexpr std::chrono::seconds kIdle{1};

}  // namespace

CommitThread::CommitThread(std::unique_ptr<Database> database, std::function<bool(Database&)> tidy,
                           std::function<void(const absl::Status&)> on_failure,
                           std::shared_ptr<StoreMetrics> metrics, const Clock& clock)
    : database_(std::move(database)),
      tidy_(std::move(tidy)),
      on_failure_(std::move(on_failure)),
      metrics_(std::move(metrics)),
      clock_(clock),
      thread_([this] { Loop(); }) {}

CommitThread::~CommitThread() {
  {
    const MutexLock lock(mutex_);
    stopping_ = true;
  }
  posted_.notify_one();
  thread_.join();
}

void CommitThread::Post(Operation operation) {
  {
    const MutexLock lock(mutex_);
    queue_.push_back(std::move(operation));
  }
  posted_.notify_one();
}

void CommitThread::Post(Task task) {
  {
    const MutexLock lock(mutex_);
    tasks_.push_back(std::move(task));
  }
  posted_.notify_one();
}

void CommitThread::Loop() {
  pthread_setname_np(pthread_self(), "store");
  while (std::optional<Batch> batch = NextBatch()) {
    const bool idle = batch->empty() && !untidy_ && !task_;
    if (!batch->empty()) {
      Commit(*batch);
      untidy_ = true;
    }
    if (untidy_) Tidy();
    if (task_) StepTask();
    if (idle) Checkpoint();
    if (database_->log_pages() > kMaxLogPages) Checkpoint();
  }
  CancelTasks();
}

std::optional<CommitThread::Batch> CommitThread::NextBatch() {
  const bool checkpointed = database_->log_pages() == 0;
  const MutexLock lock(mutex_);
  while (queue_.empty()) {
    if (stopping_) return std::nullopt;
    if (untidy_ || task_) break;
    if (!tasks_.empty()) {
      task_ = std::move(tasks_.front());
      tasks_.pop_front();
      break;
    }
    if (checkpointed) {
      posted_.wait(mutex_);
    } else if (posted_.wait_for(mutex_, kIdle) == std::cv_status::timeout) {
      break;
    }
  }
  Batch batch;
  if (queue_.size() <= kMaxBatch) {
    batch.swap(queue_);
  } else {
    const auto end = queue_.begin() + kMaxBatch;
    batch.assign(std::make_move_iterator(queue_.begin()), std::make_move_iterator(end));
    queue_.erase(queue_.begin(), end);
  }
  return batch;
}

void CommitThread::Commit(Batch& batch) {
  const auto begin = clock_.Elapsed();
  const auto run = [&] {
    for (const Operation& operation : batch) operation.run(*database_);
  };
  const bool frees = batch.size() == 1 && batch.front().frees;
  const absl::Status status = frees ? TryFreeing(run) : Try(run);
  Count(begin, batch.size(), status);
  if (status.ok() || !failure_.ok() || batch.size() == 1) {
    for (const Operation& operation : batch) operation.done(status);
    return;
  }
  // One of them does not fit, or met a damaged page: the others must not suffer for it.
  for (Operation& operation : batch) {
    Batch alone;
    alone.push_back(std::move(operation));
    Commit(alone);
  }
}

void CommitThread::Count(std::chrono::steady_clock::time_point begin, std::size_t operations,
                         const absl::Status& status) {
  if (!status.ok()) {
    ++metrics_->failed_commits;
    return;
  }
  const std::chrono::duration<double> time = clock_.Elapsed() - begin;
  metrics_->commit_seconds.Count(time.count());
  metrics_->commit_operations.Count(static_cast<double>(operations));
}

absl::Status CommitThread::Try(const std::function<void()>& work) {
  if (!failure_.ok()) return failure_;
  try {
    SQLite::Transaction transaction(database_->connection());
    work();
    transaction.commit();
    return absl::OkStatus();
  } catch (const SQLite::Exception& error) {
    absl::Status status = ToStatus(error);
    if (absl::IsUnavailable(status)) Fail(status);
    return status;
  }
}

// The log goes back to its beginning before the reserve is taken again, so nothing else gets it.
absl::Status CommitThread::TryFreeing(const std::function<void()>& work) {
  absl::Status status = Try(work);
  if (!absl::IsResourceExhausted(status) || !database_->reserve().Give()) return status;
  status = Try(work);
  Checkpoint();
  database_->reserve().Take();
  return status;
}

void CommitThread::Tidy() {
  bool more = false;
  const absl::Status status = TryFreeing([&] { more = tidy_(*database_); });
  untidy_ = status.ok() && more;
}

void CommitThread::StepTask() {
  if (!failure_.ok()) return EndTask(failure_);
  try {
    const absl::StatusOr<bool> more = task_->step(*database_);
    if (!more.ok() || !*more) EndTask(more.status());
  } catch (const SQLite::Exception& error) {
    EndTask(ToStatus(error));
  }
}

void CommitThread::EndTask(const absl::Status& status) {
  const Task task = *std::exchange(task_, std::nullopt);
  task.done(status);
}

void CommitThread::CancelTasks() {
  const absl::Status ended = absl::CancelledError("the store is being closed");
  if (task_) EndTask(ended);
  std::deque<Task> left;
  {
    const MutexLock lock(mutex_);
    left.swap(tasks_);
  }
  for (const Task& task : left) task.done(ended);
}

void CommitThread::Checkpoint() {
  if (!failure_.ok() || database_->log_pages() == 0) return;
  try {
    database_->Checkpoint();
    database_->reserve().Take();
  } catch (const SQLite::Exception& error) {
    // Without space the log goes on growing, and commits will tell.
    const absl::Status status = ToStatus(error);
    if (absl::IsUnavailable(status)) Fail(status);
  }
}

void CommitThread::Fail(const absl::Status& failure) {
  if (!failure_.ok()) return;
  failure_ = failure;
  if (on_failure_) on_failure_(failure);
}

}  // namespace contact
