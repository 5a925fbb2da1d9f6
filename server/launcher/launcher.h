#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "base/clock.h"
#include "launcher/demand.h"
#include "launcher/launcher_options.h"
#include "launcher/worker_fleet.h"

namespace contact::launcher {

/// Keeps as many workers as are wanted, by looking again and again. Ends none: workers leave by
/// themselves. Belongs to one thread.
///
/// When a start fails, or workers end soon after it, the next start waits: first for one interval,
/// then each time for twice as long, up to kLongestDelay. Workers that stay for kSettled end that.
class Launcher {
 public:
  static constexpr std::chrono::seconds kSettled{10};
  static constexpr std::chrono::minutes kLongestDelay{5};

  using Ask = std::function<absl::StatusOr<Demand>()>;
  /// `ask` tells the demand.
  Launcher(Ask ask, WorkerFleet& fleet, const Limits& limits, std::chrono::milliseconds interval,
           const Clock& clock);

  /// Looks at demand and workers, and starts those that are missing. Logs what goes wrong once.
  void Look();

 private:
  using Time = std::chrono::steady_clock::time_point;

  // What Look does; answers what is wrong at present.
  absl::Status Adjust();
  // Finds out from the present number of workers what has become of the last start.
  void Judge(int count);
  void Start(int count);
  // Has the next start wait.
  void Fail(absl::Status why);
  // Logs the state if it is new.
  void Tell(const absl::Status& state);

  const Ask ask_;
  WorkerFleet& fleet_;
  const Limits limits_;
  const std::chrono::milliseconds interval_;
  const Clock& clock_;

  // The workers after the last look, those that it started included.
  int known_ = 0;
  // When the last start was, until it is known whether its workers stay.
  std::optional<Time> on_trial_since_;
  // Why workers do not start or stay; and how long the next start waits for it, until when.
  absl::Status failure_;
  std::chrono::milliseconds delay_{0};
  Time next_start_;
  // What was logged last; empty: nothing is wrong.
  std::string told_;
};

}  // namespace contact::launcher
