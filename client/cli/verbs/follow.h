#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "cli/link/watch.h"
#include "cli/settings/settings.h"

namespace contact::cli {

using Deadline = std::optional<std::chrono::steady_clock::time_point>;

/// How many rows of the μ-iteration a run shows.
enum class IterationRows { kNone, kFirst, kAll };

/// Watches a job until Ctrl-C, showing its iteration and progress as messages.
WatchEnd FollowRun(Client& client, const std::string& name, Deadline deadline, IterationRows rows,
                   const Settings& settings);

/// Says that the job goes on without a watcher; the code for why there is none any more.
ExitCode Detach(WatchEnd end, const std::string& name);

/// The same for who looks at a terminal; Ctrl-C again within 2 s asks the job to stop, and with
/// `cancel` the first one does, on a terminal or not.
ExitCode DetachOrCancel(Client& client, WatchEnd end, const std::string& name, bool cancel,
                        const Settings& settings);

/// What to type after a job has ended.
std::string NextSteps(const v1::Job& job);

}  // namespace contact::cli
