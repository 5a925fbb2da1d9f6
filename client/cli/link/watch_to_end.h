#pragma once

#include <functional>
#include <string>

#include "cli/link/watch.h"
#include "cli/settings/settings.h"

namespace contact::cli {

/// Watches a job until it has ended and all its events were heard. While a job that has not ended
/// is waited for, a message says so, as one does of a lost connection. The time limit of `settings`
/// and Ctrl-C, while the caller holds an Interrupt, end the watch early; `options.deadline` and
/// `options.stopped` are replaced by them. Throws CallFailure as Watch does, and Failure (kTimeout,
/// kInterrupted) if the watch ends before the job.
void WatchToEnd(Client& client, WatchOptions options, const Settings& settings,
                WatchObserver& observer);

/// Calls `replay` until it returns true for a recording without holes, at most twice. Throws
/// Failure (kRunFailed), which names `job`, if both recordings have holes.
void ReplayWhole(const std::string& job, const std::function<bool()>& replay);

}  // namespace contact::cli
