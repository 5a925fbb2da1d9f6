#include "simulation/episode/problem.h"

#include <algorithm>
#include <cmath>

namespace contact {
namespace {

// A trial μ may break a motion into many cycles; what has not ended after so many is open.
constexpr int kMostCyclesOfATrial = 400;
// How far beyond the end of the run passes go for groups that it cuts: a part of the run, and of
// what the episode may last in it.
constexpr double kBeyond = 3, kOwn = 5;
// μ δⁿ T/m_e, the damping in units of what stops the bodies within the group's duration T; an
// isolated collision has some 3/ε. Of 2,700 groups of random scenarios one in a thousand needs
// more. The first group of an encounter begins at rest, so that it has a root if it ends at all.
constexpr double kFelt = 3000, kFeltAtFirst = 1e6;
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

Sight Problem::Scan(int most_cycles, bool guess, bool coarse) {
  Sight sight = Look({.tolerance = coarse ? Tolerance(kCoarsest) : 0,
                      .most_cycles = most_cycles,
                      .guess = guess,
                      .sensitive = coarse});
  sight.exact = !coarse;
  return sight;
}

Sight Problem::SeeStretch(int most_cycles) {
  return Look({.most_cycles = most_cycles, .first_quiet = true, .guess = true});
}

// The tolerance of a pass that need not be more exact than this.
double Problem::Tolerance(double wanted) const {
  const double finest = scenario_.solver.relative_tolerance;
  if (scenario_.solver.clip_tension) return 0;
  return std::clamp(wanted, finest, std::max(kCoarsest, finest));
}

double Problem::MostMu(const GroupSight& g) const {
  const Contact& contact = scenario_.contacts[static_cast<std::size_t>(g.id.contact)];
  const double duration = g.end_time - g.start_time;
  const double unit = std::pow(g.length, contact.exponent) * duration /
                      motion_.equations().effective_mass(g.id.contact);
  return (g.id.place > 1 ? kFelt : kFeltAtFirst) / g.restitution_in / unit;
}

Sight Problem::Evaluate(const std::vector<GroupId>& front, bool sensitive, double until,
                        double tolerance) {
  return Look({.tolerance = Tolerance(tolerance),
               .until = until,
               .most_cycles = kMostCyclesOfATrial,
               .sensitive = sensitive,
               .front = front});
}

}  // namespace contact
