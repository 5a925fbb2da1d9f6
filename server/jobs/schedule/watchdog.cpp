#include "jobs/schedule/watchdog.h"

#include <algorithm>
#include <utility>

namespace contact {
namespace {

// What counts as idle between two looks at most: when the whole process was held up, so was the
// run.
constexpr std::chrono::seconds kMostIdle{1};

}  // namespace

bool Watchdog::Look(RunControl& control, Time now, const Patience& patience) {
  const Time::duration since_look = now - std::exchange(last_look_, now);
  const auto passed = std::min<Time::duration>(since_look, kMostIdle);
  if (!control.waiting()) used_ += since_look;
  const auto wall_time = control.budget().wall_time;
  if (wall_time.count() > 0 && used_ >= wall_time) control.Stop(StopCause::kWallTime);
  const std::int64_t signs = control.signs();
  const bool stopping = control.stopping();
  const bool alive = signs != std::exchange(signs_, signs) ||
                     stopping != std::exchange(stopping_, stopping) || control.held();
  idle_ = alive ? std::chrono::nanoseconds(0) : idle_ + passed;
  if (stopping) return idle_ >= patience.stop;
  if (patience.step.count() > 0 && idle_ >= patience.step) control.Stop(StopCause::kStalled);
  return false;
}

}  // namespace contact
