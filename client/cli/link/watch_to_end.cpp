#include "cli/link/watch_to_end.h"

#include <fmt/format.h>

#include "cli/base/interrupt.h"

namespace contact::cli {

void WatchToEnd(Client& client, WatchOptions options, const Settings& settings,
                WatchObserver& observer) {
  options.deadline = settings.Deadline();
  options.stopped = Interrupt::raised;
  const WatchEnd end = Watch(client, options, observer);
  if (end == WatchEnd::kFinished) return;
  const bool interrupted = end == WatchEnd::kStopped;
  throw Failure(interrupted ? ExitCode::kInterrupted : ExitCode::kTimeout,
                fmt::format("{}; {} has not ended, or is long",
                            interrupted ? "interrupted" : "time is up", options.name));
}

void ReplayWhole(const std::string& job, const std::function<bool()>& replay) {
  constexpr int kTries = 2;
  for (int i = 0; i < kTries; ++i) {
    if (replay()) return;
  }
  throw Failure(ExitCode::kRunFailed,
                fmt::format("parts of the trajectory of {} do not come; try again", job));
}

}  // namespace contact::cli
