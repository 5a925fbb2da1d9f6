#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "cli/link/watch.h"
#include "cli/settings/settings.h"

namespace contact::cli {

/// When to give up; none: never.
using Deadline = std::optional<std::chrono::steady_clock::time_point>;

/// How many rows of the μ-iteration a run shows.
enum class IterationRows { kNone, kFirst, kAll };

/// Watches the job `name` and shows its iteration and progress on the standard error. Returns at
/// the end of the job, at the deadline or on Ctrl-C. Throws CallFailure.
WatchEnd FollowRun(Client& client, const std::string& name, Deadline deadline, IterationRows rows,
                   const Settings& settings);

/// Says that the job continues although contactctl ends. `end` is why the watch ended: not
/// kFinished. Returns kInterrupted or kTimeout.
ExitCode Detach(WatchEnd end, const std::string& name);

/// Like Detach, but cancels the job if the user wants that: with `cancel` the first Ctrl-C cancels
/// it, and on a terminal a second one within 2 s. Throws CallFailure.
ExitCode DetachOrCancel(Client& client, WatchEnd end, const std::string& name, bool cancel,
                        const Settings& settings);

/// Lines with commands that are useful after `job` has ended.
std::string NextSteps(const v1::Job& job);

}  // namespace contact::cli
