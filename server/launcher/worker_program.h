#pragma once

#include <string>
#include <vector>

#include "launcher/launcher_options.h"
#include "launcher/process.h"

namespace contact::launcher {

/// The program of a worker. The address of the store, which may hold a password, is in its
/// environment and not among its words. Other CONTACTD_* variables are the launcher's own.
Program WorkerProgram(const LauncherOptions& options, const std::string& store,
                      const std::vector<std::string>& environment);

/// The environment of this process.
std::vector<std::string> OwnEnvironment();

/// When a worker leaves that Slurm ends after `limit`. From a limit of four minutes on Slurm's
/// notice, which may come a minute early, is not before this. 0: it has no limit.
std::chrono::seconds StopAfter(std::chrono::seconds limit);

}  // namespace contact::launcher
