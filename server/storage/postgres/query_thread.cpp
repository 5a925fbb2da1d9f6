#include "storage/postgres/query_thread.h"

#include <pthread.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

namespace contact::postgres {
namespace {

using namespace std::chrono_literals;

// Bounds how long an operation waits for those before it in the same transaction.
constexpr std::size_t kMaxBatch = 256;
constexpr std::size_t kMaxBatchBytes = std::size_t{4} << 20;
// How soon after a transaction with a change patient operations alone are worth the next. A short
// job ends meanwhile.
constexpr auto kPause = 5ms;
// Nobody is told of a loss that is mended within this time.
constexpr auto kPatience = 2s;
constexpr auto kReconnectTime = 100ms;
// How often one transaction is tried that others are in the way of.
constexpr int kMaxTries = 5;

}  // namespace

QueryThread::QueryThread(Opener open, std::unique_ptr<Connection> connection, Statement tidy,
                         std::shared_ptr<StoreMetrics> metrics, const Clock& clock)
    : open_(std::move(open)),
      connection_(std::move(connection)),
      session_(connection_->session()),
      tidy_(std::move(tidy)),
      metrics_(std::move(metrics)),
      clock_(clock),
      thread_([this] { Loop(); }) {}

QueryThread::~QueryThread() {
  {
    const MutexLock lock(mutex_);
    stopping_ = true;
  }
  posted_.notify_one();
  thread_.join();
}

void QueryThread::Post(Operation operation) {
  {
    const MutexLock lock(mutex_);
    queue_.push_back(std::move(operation));
  }
  posted_.notify_one();
}

bool QueryThread::Recall(std::uint64_t id) {
  std::optional<Operation> recalled;  // Goes after the lock.
  const MutexLock lock(mutex_);
  const auto found = std::ranges::find(queue_, id, &Operation::id);
  if (found == queue_.end()) return false;
  recalled = std::move(*found);
  queue_.erase(found);
  return true;
}

void QueryThread::Loop() {
  pthread_setname_np(pthread_self(), "store");
  while (std::optional<Batch> batch = NextBatch()) {
    if (batch->empty()) {
      Tidy();
    } else {
      Run(*batch);
    }
  }
}

std::size_t QueryThread::Ready() const {
  if (stopping_ || !last_change_ || clock_.Elapsed() - *last_change_ >= kPause) {
    return queue_.size();
  }
  const auto urgent = std::find_if(queue_.rbegin(), queue_.rend(),
                                   [](const Operation& operation) { return !operation.patient; });
  return static_cast<std::size_t>(queue_.rend() - urgent);
}

std::optional<QueryThread::Batch> QueryThread::NextBatch() {
  const MutexLock lock(mutex_);
  std::size_t ready = 0;
  while ((ready = Ready()) == 0) {
    if (!queue_.empty()) {
      posted_.wait_for(mutex_, *last_change_ + kPause - clock_.Elapsed());
    } else {
      if (stopping_) return std::nullopt;
      if (untidy_) return Batch{};
      posted_.wait(mutex_);
    }
  }
  Batch batch;
  std::size_t bytes = 0;
  while (batch.size() < std::min(ready, kMaxBatch) && bytes < kMaxBatchBytes) {
    bytes += queue_.front().statement.parameters.bytes();
    untidy_ |= queue_.front().untidy;
    if (queue_.front().id != 0) last_change_ = clock_.Elapsed();
    batch.push_back(std::move(queue_.front()));
    queue_.pop_front();
  }
  return batch;
}

void QueryThread::Run(Batch& batch) {
  const auto begin = clock_.Elapsed();
  std::vector<const Statement*> statements;
  for (const Operation& operation : batch) {
    if (!operation.statement.sql.empty()) statements.push_back(&operation.statement);
  }
  absl::StatusOr<std::vector<Rows>> answers = std::vector<Rows>();
  if (!statements.empty()) answers = Ask(statements);
  if (answers.ok()) {
    const std::chrono::duration<double> time = clock_.Elapsed() - begin;
    metrics_->commit_seconds.Count(time.count());
    metrics_->commit_operations.Count(static_cast<double>(batch.size()));
    auto answer = answers->begin();
    for (const Operation& operation : batch) {
      operation.done(operation.statement.sql.empty() ? Rows() : std::move(*answer++));
    }
    return;
  }
  ++metrics_->failed_commits;
  if (batch.size() == 1 || absl::IsUnavailable(answers.status())) {
    for (const Operation& operation : batch) operation.done(answers.status());
    return;
  }
  // One of them cannot be done: the others must not suffer for it.
  for (Operation& operation : batch) {
    Batch alone;
    alone.push_back(std::move(operation));
    Run(alone);
  }
}

absl::StatusOr<std::vector<Rows>> QueryThread::Ask(
    const std::vector<const Statement*>& statements) {
  const auto begin = clock_.Elapsed();
  for (int tries = 1; Connect(); ++tries) {
    absl::StatusOr<std::vector<Rows>> answers = connection_->Run(statements);
    const bool in_the_way = absl::IsAborted(answers.status());
    if (in_the_way && statements.size() > 1) return answers;
    if (!in_the_way && !absl::IsUnavailable(answers.status())) return answers;
    // Also one that stands: it may be half-way in an answer, or that of a standby.
    if (!in_the_way) connection_.reset();
    // Of a call ABORTED says something else.
    const bool patient = !in_the_way && clock_.Elapsed() - begin < kPatience;
    if (tries >= kMaxTries && !patient) return absl::UnavailableError("the database is too busy");
  }
  return lost_;
}

bool QueryThread::Connect() {
  if (connection_ && connection_->good()) return true;
  if (lost_.ok()) lost_since_ = clock_.Elapsed();
  do {
    absl::StatusOr<std::unique_ptr<Connection>> opened = Reopen();
    if (opened.ok()) {
      if (!lost_.ok()) spdlog::info("the database answers again");
      lost_ = absl::OkStatus();
      connection_ = *std::move(opened);
      return true;
    }
    if (lost_.ok()) spdlog::error("{}", std::string(opened.status().message()));
    lost_ = absl::UnavailableError("the database does not answer");
    const MutexLock lock(mutex_);
    if (stopping_) return false;
    posted_.wait_for(mutex_, kReconnectTime);
  } while (clock_.Elapsed() - lost_since_ < kPatience);
  return false;
}

absl::StatusOr<std::unique_ptr<Connection>> QueryThread::Reopen() {
  absl::StatusOr<std::unique_ptr<Connection>> opened = open_();
  if (!opened.ok()) return opened;
  // A network may hold back what the last one was sent, and deliver it after what this one is.
  if (absl::Status ended = (*opened)->End(session_); !ended.ok()) return ended;
  session_ = (*opened)->session();
  return opened;
}

void QueryThread::Tidy() {
  const auto more = Ask({&tidy_});
  untidy_ = more.ok() && more->front().Integer(0, 0) != 0;
}

}  // namespace contact::postgres
