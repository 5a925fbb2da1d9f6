#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "cli/link/watch.h"
#include "cli/settings/settings.h"

namespace contact::cli {

/// When to give up; none: never.
using Deadline = std::optional<std::chrono::steady_clock::time_point>;

/// How many rows of the μ-iteration a run shows: none, the first 60, or all.
enum class IterationRows { kNone, kFirst, kAll };

/// Watches the job `name` and shows its iteration and progress on the standard error. Returns at
/// the end of the job, at the deadline or on Ctrl-C. Throws CallFailure.
WatchEnd FollowRun(Client& client, const std::string& name, Deadline deadline, IterationRows rows,
                   const Settings& settings);

/// Fetches the job `name`, which has ended, and prints it as -o asks; a table is followed by
/// NextSteps on the standard error. `columns` selects columns of the ledger; empty: all. Returns
/// the exit code for how the job ended. Throws CallFailure.
ExitCode PrintResult(Client& client, const std::string& name, const Settings& settings,
                     const std::vector<std::string>& columns = {});

/// Watches the job `name` for events of these kinds until its end, the deadline of `settings`, or
/// Ctrl-C while the caller holds an Interrupt. Throws CallFailure.
WatchEnd WatchJob(Client& client, const std::string& name, const std::vector<std::string>& kinds,
                  const Settings& settings, WatchObserver& observer);

/// Waits for the end of the job `name` and shows nothing. Ends early at the deadline of `settings`
/// and on Ctrl-C. Throws CallFailure.
WatchEnd AwaitEnd(Client& client, const std::string& name, const Settings& settings);

/// Asks the server to stop the job `name`. Returns the job as it is then. Throws CallFailure.
v1::Job CancelJob(Client& client, const std::string& name);

/// Deletes the job `name`, which has ended. Throws CallFailure.
void DeleteJob(Client& client, const std::string& name);

/// Says that the job continues although contactctl ends. `end` is why the watch ended: not
/// kFinished. Returns kInterrupted or kTimeout.
ExitCode Detach(WatchEnd end, const std::string& name);

/// Like Detach, but cancels the job if the user wants that: with `cancel` the first Ctrl-C cancels
/// it, and on a terminal a second one within 2 s. Throws CallFailure.
ExitCode DetachOrCancel(Client& client, WatchEnd end, const std::string& name, bool cancel,
                        const Settings& settings);

/// Lines with commands that are useful after `job` has ended, and with ConvergenceHints.
std::string NextSteps(const v1::Job& job);

}  // namespace contact::cli
