#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

namespace contact::launcher {

/// What runs the workers, such as Slurm. Workers end by themselves.
class WorkerFleet {
 public:
  virtual ~WorkerFleet() = default;

  /// Starts `count` workers, at least one, or has them wait for a place. Returns before they run.
  virtual absl::Status Start(int count) = 0;
  /// The workers that run, start, or wait for a place.
  virtual absl::StatusOr<int> Count() = 0;
};

}  // namespace contact::launcher
