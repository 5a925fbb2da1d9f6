#pragma once

#include <set>

#include "launcher/process.h"
#include "launcher/worker_fleet.h"

namespace contact::launcher {

/// Workers as child processes, which end with their launcher.
class ExecFleet final : public WorkerFleet {
 public:
  /// A worker that is asked to end gets `grace` for it.
  explicit ExecFleet(Program worker, std::chrono::milliseconds grace = std::chrono::seconds(10));
  ~ExecFleet() override;
  ExecFleet(const ExecFleet&) = delete;
  ExecFleet& operator=(const ExecFleet&) = delete;

  absl::Status Start(int count) override;
  /// Logs how workers have ended that have failed.
  absl::StatusOr<int> Count() override;

 private:
  const Program worker_;
  const std::chrono::milliseconds grace_;
  std::set<pid_t> children_;
};

}  // namespace contact::launcher
