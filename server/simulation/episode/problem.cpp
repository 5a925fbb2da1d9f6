#include "simulation/episode/problem.h"

#include <algorithm>

namespace contact {
namespace {

// A trial μ may break a motion into many cycles; what has not ended after so many is open.
constexpr int kMostCyclesOfATrial = 400;
// How far beyond the end of the run passes go for groups that it cuts: a part of the run, and of
// what the episode may last in it.
constexpr double kBeyond = 0.5, kOwn = 2;
// Coarser passes miss events.
constexpr double kCoarsest = 1e-6;

}  // namespace

void Problem::Begin(const State& start, double end, const std::stop_token& stop,
                    std::int64_t step_limit) {
  start_ = &start;
  end_ = end;
  horizon_ = end + std::max(kBeyond * end, kOwn * (end - start.time));
  stop_ = stop;
  step_limit_ = step_limit;
  aborted_ = false;
}

Sight Problem::Look(Pass::Plan plan) {
  ++passes_;
  plan.end = end_;
  plan.until = std::min(plan.until, horizon_);
  Sight sight = pass_.Look(*start_, plan, stop_, step_limit_);
  pause_ = sight.pause;
  aborted_ = pause_ == Motion::Pause::kStopped || pause_ == Motion::Pause::kStepLimit;
  return sight;
}

Sight Problem::Scan(int most_cycles, bool guess) {
  return Look({.most_cycles = most_cycles, .guess = guess});
}

Sight Problem::SeeStretch(int most_cycles) {
  return Look({.most_cycles = most_cycles, .first_quiet = true, .guess = true});
}

Sight Problem::Evaluate(const std::vector<GroupId>& front, bool sensitive, double until,
                        double tolerance) {
  const double finest = scenario_.solver.relative_tolerance;
  return Look({.tolerance = scenario_.solver.clip_tension
                                ? 0
                                : std::clamp(tolerance, finest, std::max(kCoarsest, finest)),
               .until = until,
               .most_cycles = kMostCyclesOfATrial,
               .sensitive = sensitive,
               .front = front});
}

}  // namespace contact
