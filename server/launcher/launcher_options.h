#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace contact::launcher {

/// How many workers there may be.
struct Limits {
  int min_workers = 0;  ///< Processes that there are even if nothing waits.
  int max_workers = 1;  ///< Processes at most.
  int threads = 1;      ///< Simulations that one process runs at once.
};

/// What a worker is told when it is started.
struct WorkerOptions {
  std::string command = "/proc/self/exe";  ///< The program, a path or a name in PATH.
  std::chrono::seconds exit_when_idle{
      300};                          ///< It leaves when it had no job for so long; 0: never.
  std::vector<std::string> options;  ///< More words, after those that the launcher makes.
};

/// How Slurm is asked for a worker. What is empty or 0 is left to Slurm.
struct SlurmOptions {
  std::string partition;
  std::string account;
  std::chrono::minutes time{0};  ///< Time limit of a worker.
  std::string job_name =
      "contactd-worker";  ///< Tells the workers of this launcher from other jobs.
  std::string output = "contactd-worker-%j.log";  ///< File of a worker's log.
  std::vector<std::string>
      options;  ///< More words for sbatch, after those that the launcher makes.
};

/// What runs the workers.
enum class Engine { kExec, kSlurm };

/// Settings of the role `launcher`.
struct LauncherOptions {
  Engine engine = Engine::kExec;
  Limits limits;
  std::chrono::milliseconds interval{2000};  ///< Time between two looks.
  WorkerOptions worker;
  SlurmOptions slurm;
};

}  // namespace contact::launcher
