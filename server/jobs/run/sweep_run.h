#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "base/mutex.h"
#include "contact/v1/scenario.pb.h"
#include "jobs/job/job_options.h"
#include "jobs/run/cell_solver.h"
#include "jobs/run/run_control.h"
#include "wire/sweep/sweep_codec.h"

namespace contact {

/// A sweep while it runs: hands its cells out to the threads that compute them. Thread-safe.
class SweepRun {
 public:
  /// Both are called by the threads that compute, several at a time.
  struct Sink {
    std::function<void(SolvedCell)> store;  ///< Takes each cell, as it is finished.
    std::function<void()> pulse;            ///< Now and then while a cell is computed.
  };

  /// Cells for which `done` is true have been computed before. `options` outlives the run, the sink
  /// what was begun.
  SweepRun(v1::Sweep sweep, DecodedSweep plan, std::vector<bool> done, const JobOptions& options,
           std::shared_ptr<RunControl> control, Sink sink);

  const std::shared_ptr<RunControl>& control() const { return control_; }

  /// True while there is a cell that nobody has begun.
  bool HasWork() const;
  /// Computes cells for about so long, one at least. False: there was none.
  bool Work(std::chrono::milliseconds slice);
  /// Waits until nobody computes a cell, for so long at most. False: somebody does.
  bool AwaitIdle(std::chrono::milliseconds limit);

 private:
  std::optional<std::int32_t> Claim();
  void Release();
  void SkipDone() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  bool HasWorkLocked() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const v1::Sweep sweep_;
  const DecodedSweep plan_;
  const std::vector<bool> done_;
  const JobOptions& options_;
  const std::shared_ptr<RunControl> control_;
  const Sink sink_;

  mutable Mutex mutex_;
  std::condition_variable_any released_;
  std::int32_t next_ ABSL_GUARDED_BY(mutex_) = 0;  ///< To be begun; past the last if there is none.
  int begun_ ABSL_GUARDED_BY(mutex_) = 0;          ///< And not taken by the sink yet.
};

}  // namespace contact
