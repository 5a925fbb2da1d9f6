#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "base/mutex.h"
#include "storage/postgres/connection.h"
#include "storage/store_metrics.h"

namespace contact::postgres {

/// The one thread that uses the store's connection. Statements posted while it works go together
/// into the next transaction, so that one turn of the network and one sync of the disk serve them
/// all; one that comes alone does not wait for others.
///
/// When the connection is lost the thread opens another, ends the session of the first, and sends
/// again what was not answered. Every statement must therefore be one that may be done twice, but
/// not one that may be done late.
class QueryThread {
 public:
  struct Operation {
    /// Empty SQL: nothing is to be done, only told.
    Statement statement = {};
    /// Runs once, after the commit or with the reason why there is none.
    std::function<void(absl::StatusOr<Rows>)> done = {};
    /// By which it can be recalled, as a change of a job; 0: it cannot.
    std::uint64_t id = 0;
    /// It is not worth a transaction of its own a few milliseconds after another change. The first
    /// is: what takes a job must be there if the job ends the process.
    bool patient = false;
    /// It leaves something to tidy up.
    bool untidy = false;
  };

  /// Opens a connection and makes it ready for use.
  using Opener = std::function<absl::StatusOr<std::unique_ptr<Connection>>()>;
  /// `tidy`: a statement that is run at the start and after untidy operations, when there is
  /// nothing else to do, and again until it answers false.
  QueryThread(Opener open, std::unique_ptr<Connection> connection, Statement tidy,
              std::shared_ptr<StoreMetrics> metrics, const Clock& clock);
  /// Does what was posted, then joins. Without a connection it is answered with UNAVAILABLE.
  ~QueryThread();

  /// Thread-safe; returns at once. Operations take effect in the order of their posting.
  void Post(Operation operation);
  /// Forgets an operation that still waits to be sent. False: there is none.
  bool Recall(std::uint64_t id);

 private:
  using Batch = std::vector<Operation>;

  // All private methods run on the thread.
  void Loop();
  // How many operations the next transaction may have: up to the last that is not patient, or all.
  std::size_t Ready() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // Waits for operations. Empty: it is time to tidy up. None: it is time to stop.
  std::optional<Batch> NextBatch();
  // Runs a batch as one transaction, or its operations one by one if that fails, and tells them.
  void Run(Batch& batch);
  // The answers, from a new connection if the old one is lost. UNAVAILABLE: none is to be had.
  absl::StatusOr<std::vector<Rows>> Ask(const std::vector<const Statement*>& statements);
  // A connection, for so long as it may take to open one. False: none is to be had.
  bool Connect();
  // A new connection, once the session of the last one has ended.
  absl::StatusOr<std::unique_ptr<Connection>> Reopen();
  void Tidy();

  // Used by the thread alone, as all members up to `mutex_`.
  const Opener open_;
  std::unique_ptr<Connection> connection_;
  // Of the newest connection.
  std::string session_;
  const Statement tidy_;
  const std::shared_ptr<StoreMetrics> metrics_;
  const Clock& clock_;
  // True while `tidy_` may have something to do.
  bool untidy_ = true;
  // When the last change was sent; none before the first.
  std::optional<std::chrono::steady_clock::time_point> last_change_;
  // Why there is no connection, and since when.
  absl::Status lost_;
  std::chrono::steady_clock::time_point lost_since_;

  Mutex mutex_;
  std::condition_variable_any posted_;
  std::deque<Operation> queue_ ABSL_GUARDED_BY(mutex_);
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;
  // Last, because it uses all of the above.
  std::thread thread_;
};

}  // namespace contact::postgres
