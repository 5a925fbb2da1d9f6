#pragma once

#include <chrono>
#include <functional>

#include "storage/shared_store.h"

namespace contact {

/// What a process does for the jobs of a store that others share.
struct SharedOptions {
  /// Who it is. Its threads are JobOptions::workers.
  WorkerProcess process = {};
  /// True if it runs jobs, too.
  bool works = true;
  /// A worker that has had no job for so long calls `leave`; 0: never.
  std::chrono::milliseconds exit_when_idle{0};
  /// Called at most once, on a thread that must not be waited for: the process is to end.
  std::function<void()> leave = [] {};
};

}  // namespace contact
