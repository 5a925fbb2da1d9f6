#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "launcher/launcher_options.h"
#include "launcher/process.h"
#include "launcher/worker_fleet.h"

namespace contact::launcher {

/// Workers as batch jobs of Slurm, which stay when their launcher ends. All jobs of this user with
/// the job name of the options are workers of this launcher.
class SlurmFleet final : public WorkerFleet {
 public:
  /// `threads`: cores that a worker needs.
  SlurmFleet(Program worker, SlurmOptions options, int threads);

  absl::Status Start(int count) override;
  absl::StatusOr<int> Count() override;

 private:
  const Program worker_;
  const SlurmOptions options_;
  const int threads_;
};

/// The words of the sbatch that submits a worker; it reads its script from its input. Slurm sends
/// SIGTERM a minute or two before the time limit.
std::vector<std::string> SbatchWords(const SlurmOptions& options, int threads);

/// The words of the squeue that lists the workers, one a line.
std::vector<std::string> SqueueWords(const SlurmOptions& options);

/// A script that becomes the program.
std::string BatchScript(const std::vector<std::string>& words);

/// The jobs in an answer of squeue. INTERNAL: it is none.
absl::StatusOr<int> CountJobs(std::string_view answer);

}  // namespace contact::launcher
