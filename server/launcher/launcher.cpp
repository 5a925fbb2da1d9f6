#include "launcher/launcher.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "launcher/wanted.h"

namespace contact::launcher {

Launcher::Launcher(Ask ask, WorkerFleet& fleet, const Limits& limits,
                   std::chrono::milliseconds interval, const Clock& clock)
    : ask_(std::move(ask)),
      fleet_(fleet),
      limits_(limits),
      interval_(interval),
      clock_(clock),
      next_start_(clock.Elapsed()) {}

void Launcher::Look() { Tell(Adjust()); }

absl::Status Launcher::Adjust() {
  const absl::StatusOr<Demand> demand = ask_();
  if (!demand.ok()) return demand.status();
  const absl::StatusOr<int> count = fleet_.Count();
  if (!count.ok()) return count.status();
  Judge(*count);
  const int missing = Wanted(*demand, limits_) - *count;
  if (missing > 0 && clock_.Elapsed() >= next_start_) Start(missing);
  return failure_;
}

void Launcher::Judge(int count) {
  const bool lost = count < known_;
  known_ = count;
  if (!on_trial_since_) return;
  if (lost) {
    Fail(absl::UnavailableError("workers end soon after their start; their log says why"));
  } else if (clock_.Elapsed() - *on_trial_since_ >= kSettled) {
    on_trial_since_.reset();
    failure_ = absl::OkStatus();
    delay_ = {};
  }
}

void Launcher::Start(int count) {
  if (absl::Status status = fleet_.Start(count); !status.ok()) return Fail(std::move(status));
  spdlog::info("workers started: {}, beside {}", count, known_);
  known_ += count;
  on_trial_since_ = clock_.Elapsed();
}

void Launcher::Fail(absl::Status why) {
  on_trial_since_.reset();
  failure_ = std::move(why);
  delay_ = std::clamp<std::chrono::milliseconds>(2 * delay_, interval_, kLongestDelay);
  next_start_ = clock_.Elapsed() + delay_;
}

void Launcher::Tell(const absl::Status& state) {
  if (state.message() == told_) return;
  told_ = std::string(state.message());
  if (state.ok()) {
    spdlog::info("all is well again");
  } else {
    spdlog::error("{}", told_);
  }
}

}  // namespace contact::launcher
