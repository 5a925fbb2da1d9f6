#include "simulation/episode/problem.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace contact {
namespace {

// A trial μ may break a motion into many cycles; what has not ended after so many is open.
constexpr int kMostCyclesOfATrial = 400;
// What is far beyond the end of the run: a part of the run, and of what the episode may last in it.
constexpr double kBeyond = 3, kOwn = 5;
// μ δⁿ T/m_e, the damping in units of what stops the bodies within the group's duration T; an
// isolated collision has some 3/ε. Of 2,700 groups of random scenarios one in a thousand needs
// more. The first group of an encounter begins at rest, so that it has a root if it ends at all.
// What loads press creeps on where damping stops all else (with 3,000 stack 1 of the machines takes
// five times the steps), and what a sine drives never stops.
constexpr double kFelt = 3000, kFeltWhenPressed = 3e4, kFeltWhenDriven = 1e5, kFeltAtFirst = 1e6;
// Part of a scan that passes have to be spared for a state to be kept, and how long before the
// block it is taken.
constexpr double kWorth = 0.1, kShortly = 1e-3;
// So often a pass is made again because a rest in it should have ended earlier.
constexpr int kMostRetries = 30;
// Before all that begins.
constexpr double kAlways = -1e300;

bool Swings(const Scenario& scenario) {
  const auto is_sine = [](const auto& piece) { return piece.amplitude != 0; };
  return std::ranges::any_of(scenario.loads, is_sine) ||
         std::ranges::any_of(scenario.drives, is_sine);
}

}  // namespace

Problem::Problem(const Scenario& scenario, Motion& motion, Observer& observer)
    : scenario_(scenario),
      motion_(motion),
      pass_(scenario, motion, observer, groups),
      swings_(Swings(scenario)) {}

void Problem::Begin(const State& start, double end, const std::stop_token& stop,
                    std::int64_t step_limit) {
  start_ = &start;
  end_ = end;
  far_ = end + std::max(kBeyond * end, kOwn * (end - start.time));
  stop_ = stop;
  step_limit_ = step_limit;
  aborted_ = false;
  coarse_ = exact_ = {};
  begun_.clear();
}

// A pass from a state that is kept, or from the start.
Sight Problem::Look(const Kept* from, Pass::Plan plan) {
  ++passes_;
  plan.end = end_;
  plan.far = far_;
  plan.before = from != nullptr ? &from->led : nullptr;
  const State& state = from != nullptr ? from->state : *start_;
  Sight sight = pass_.Look(state, plan, stop_, step_limit_);
  for (int i = 1; sight.disturbed; ++i) {  // From the start: the state kept may have been at rest.
    coarse_ = exact_ = {};
    plan.before = nullptr;
    plan.retries = i < kMostRetries;
    sight = pass_.Look(*start_, plan, stop_, step_limit_);
  }
  pause_ = sight.pause;
  aborted_ = pause_ == Motion::Pause::kStopped || pause_ == Motion::Pause::kStepLimit;
  return sight;
}

Sight Problem::SeeStretch(int most_cycles) {
  return Look(nullptr, {.most_cycles = most_cycles, .first_quiet = true, .guess_from = kAlways});
}

// Whether the μ of a group that runs is a mere guess.
bool Problem::IsGuessed(const Sight& sight) const {
  return std::ranges::any_of(sight.groups, [&](const GroupSight& g) {
    const Unknown* u = groups.Find(g.id);
    return g.sought && !g.ended && u != nullptr && !u->corrected && !u->Decided() && !u->weak;
  });
}

Sight Problem::March(const std::vector<GroupId>& block, const Marching& how) {
  const double tolerance = Tolerance(how.tolerance);
  const std::vector<GroupId>& since = how.since.empty() ? block : how.since;
  const Kept* from = since.empty() ? nullptr : Before(since, how.tolerance);
  if (from != nullptr && IsGuessed(from->led)) from = nullptr;  // It may be guessed better by now.
  if (aborted_) return {};
  Sight sight = Look(from, {.tolerance = tolerance,
                            .most_cycles = kMostCyclesOfATrial,
                            .guess_from = how.guess_from,
                            .sensitive = how.slopes,
                            .wide = how.wide,
                            .to_miss = how.miss,
                            .block_until = how.until,
                            .block = block});
  sight.exact = tolerance == 0 || tolerance <= motion_.finest();
  seen_ = sight.time;
  return sight;
}

Motion::Pause Problem::SeeFlight() { return Look(nullptr, {.until = end_, .patient = true}).pause; }

// The tolerance of a pass that need not be more exact than this.
double Problem::Tolerance(double wanted) const {
  return scenario_.solver.clip_tension ? 0 : std::max(wanted, motion_.finest());
}

double Problem::MostMu(const GroupSight& g) const {
  const Contact& contact = scenario_.contacts[static_cast<std::size_t>(g.id.contact)];
  const double duration = g.end_time - g.start_time;
  const double unit = std::pow(g.depth, contact.exponent) * duration /
                      motion_.equations().effective_mass(g.id.contact);
  const bool pressed = !scenario_.loads.empty() || !scenario_.drives.empty();
  const double felt = swings_ ? kFeltWhenDriven : pressed ? kFeltWhenPressed : kFelt;
  return (g.id.place > 1 ? felt : kFeltAtFirst) / g.restitution_in / unit;
}

std::vector<Problem::Held> Problem::HeldIn(const State& state) const {
  std::vector<Held> held;
  for (const auto& [id, u] : groups.known()) {
    if (HasBegun(state, id)) held.emplace_back(id, u.mu, u.lasts, u.weak);
  }
  return held;
}

// What happens later changes nothing earlier: a pass that is to show a block may begin shortly
// before it, at a state that is kept for the passes that follow; null: at the start. A pass that
// goes ahead begins where one as coarse has been.
const Problem::Kept* Problem::Before(const std::vector<GroupId>& block, double tolerance) {
  Kept& kept = tolerance > 0 ? coarse_ : exact_;
  const auto has_begun = [&](const State& state) {
    return std::ranges::any_of(block, [&](const GroupId& id) { return HasBegun(state, id); });
  };
  const bool keeps =
      !kept.state.positions.empty() && !has_begun(kept.state) && kept.held == HeldIn(kept.state);
  const Kept* from = keeps ? &kept : nullptr;
  const double start = start_->time, from_time = keeps ? kept.state.time : start;
  double begin = kNever;  // By the last pass that saw it: with other μ it may be another.
  for (const GroupId& id : block) {
    begin = std::min(begin, groups.At(id).start_time);
    if (const auto known = begun_.find(id); known != begun_.end()) {
      begin = std::min(begin, known->second);
    }
  }
  if (begin - from_time < kWorth * (seen_ - start)) return from;
  Sight led = Look(from, {.tolerance = Tolerance(tolerance),
                          .until = begin - kShortly * (begin - start),
                          .most_cycles = kMostCyclesOfATrial,
                          .block = {block.front()}});
  if (kept.state.positions.empty()) from = nullptr;  // A rest should have ended earlier.
  if (led.pause != Motion::Pause::kTimeUp) return from;
  State reached = motion_.Save();
  if (has_begun(reached)) {
    for (const GroupId& id : block) {
      if (HasBegun(reached, id)) begun_[id] = groups.At(id).start_time;
    }
    return from;
  }
  std::vector<Held> held = HeldIn(reached);
  kept = {.state = std::move(reached), .held = std::move(held), .led = std::move(led)};
  return &kept;
}

Sight Problem::Evaluate(const std::vector<GroupId>& block, bool sensitive, double until,
                        double tolerance) {
  const Kept* from = Before(block, 0);
  if (aborted_) return {};
  return Look(from, {.tolerance = Tolerance(tolerance),
                     .until = until,
                     .most_cycles = kMostCyclesOfATrial,
                     .sensitive = sensitive,
                     .block = block});
}

}  // namespace contact
