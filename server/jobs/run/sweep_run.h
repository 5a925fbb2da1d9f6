#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "base/clock.h"
#include "base/mutex.h"
#include "contact/v1/scenario.pb.h"
#include "jobs/job/job_options.h"
#include "jobs/run/cell_solver.h"
#include "jobs/run/run_control.h"
#include "wire/sweep/sweep_codec.h"

namespace contact {

/// What became of cells that were computed elsewhere.
struct CellCounts {
  std::int32_t cells = 0;
  std::int32_t failed = 0;
  std::int32_t not_converged = 0;
  /// Integration steps.
  std::int64_t steps = 0;
};

/// A sweep while it runs: hands its cells out to the threads that compute them. Thread-safe.
class SweepRun {
 public:
  /// Receives what the computing threads produce. Both functions are called by several threads at
  /// a time.
  struct Sink {
    /// Takes each cell as soon as it is computed.
    std::function<void(SolvedCell)> store;
    /// Called now and then while a cell is computed.
    std::function<void()> write;
    /// Counts cells that others have computed and stored.
    std::function<void(const CellCounts&)> count = [](const CellCounts&) {};
  };

  /// Cells for which `done` is true have been computed before. Clock and options outlive the run.
  /// The sink must stay valid until every call of Work that has begun a cell has returned.
  SweepRun(v1::Sweep sweep, DecodedSweep plan, std::vector<bool> done, const Clock& clock,
           const JobOptions& options, std::shared_ptr<RunControl> control, Sink sink);

  /// A range of cells.
  struct Cells {
    std::int32_t first;
    std::int32_t last;
    std::int32_t count() const { return last - first + 1; }
  };
  /// Gives away cells that nobody has begun, `most` at most: they count as begun until they are put
  /// back or Returned. Nothing: there are none.
  std::optional<Cells> Lend(std::int32_t most);
  /// Cells that were lent come back as they were.
  void PutBack(const Cells& cells);
  /// Cells that were lent are in the log.
  void Returned(const CellCounts& counts);
  /// Cells that nobody has begun.
  std::int32_t waiting() const;

  /// The control of the attempt that runs the sweep.
  const std::shared_ptr<RunControl>& control() const { return control_; }

  /// True while there is a cell that nobody computes or has computed.
  bool HasWork() const;
  /// Computes cells until `slice` has passed, at least one, unless it has to `leave` that: see
  /// Meanwhile. False: there was none left.
  bool Work(std::chrono::milliseconds slice, const std::function<bool()>& leave);
  /// Waits until all cells are computed, or one is left for the caller to compute, at most for
  /// `limit` of real time. True: all are.
  bool AwaitEnd(std::chrono::milliseconds limit);

 private:
  /// The cell that the calling thread is to compute; none if there is none left.
  std::optional<std::int32_t> Claim();
  /// Says that the sink has the claimed cell, or that somebody else is to compute it.
  void Release(std::int32_t cell, bool computed);
  /// Moves next_ past the cells that were computed before.
  void SkipDone() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  /// As HasWork.
  bool HasWorkLocked() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const v1::Sweep sweep_;
  const DecodedSweep plan_;
  /// Cells that were computed before.
  const std::vector<bool> done_;
  const Clock& clock_;
  const JobOptions& options_;
  const std::shared_ptr<RunControl> control_;
  const Sink sink_;

  mutable Mutex mutex_;
  /// Notified when a cell was released.
  std::condition_variable_any released_;
  /// Cells that were begun and left.
  std::vector<std::int32_t> left_ ABSL_GUARDED_BY(mutex_);
  /// The next cell to begin, or the number of cells.
  std::int32_t next_ ABSL_GUARDED_BY(mutex_) = 0;
  /// Cells that were begun and that the sink has not taken.
  int begun_ ABSL_GUARDED_BY(mutex_) = 0;
  /// Cells that nobody has begun.
  std::int32_t waiting_ ABSL_GUARDED_BY(mutex_) = 0;
};

}  // namespace contact
