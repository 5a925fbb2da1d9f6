#include "simulation/episode/march.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "simulation/episode/search_options.h"

namespace contact {

bool March::IsSettled(const GroupId& id) const {
  const auto polished = polished_.find(id);
  return polished != polished_.end() && polished->second.settled;
}

Timeline March::Read(const Sight& sight) const {
  return {sight, problem_.groups, problem_.end(),
          [this](const GroupId& id) { return IsSettled(id); }};
}

Sight March::Look(const Ids& since) {
  return problem_.March({}, {.since = since,
                             .slopes = coarse_,
                             .tolerance = coarse_ ? kSearch.ahead_tolerance : 0,
                             .miss = ahead_,
                             .guess_from = 0});
}

// What a pass tells of each group. Returns those that have become negligible or are no more, for
// that changes their μ.
March::Ids March::Note(const Sight& sight) {
  Ids changed;
  for (const GroupSight& g : sight.groups) {
    Unknown& u = problem_.groups.At(g.id);
    if (g.ended || sight.time >= problem_.end()) u.cut = !g.ended || g.end_time > problem_.end();
    if (!g.ended) continue;
    if (u.length == 0) u.length = g.length, u.speed = g.speed;
    // A coarse pass may find what is negligible, but not that it is no more.
    if (sight.exact || (g.weak && u.flips == 0)) {
      const bool flips = g.sought && u.weak != g.weak;
      if (flips) changed.push_back(g.id);
      u.flips += flips;
      u.weak = g.weak;
    }
    u.restitution_out = std::sqrt(std::max(g.squared, 0.0));
    const bool ends_after_all = sight.exact && u.status == Cycle::Status::kUnfinished &&
                                g.end_time <= problem_.end() && u.reopened < kSearch.revisions;
    u.reopened += ends_after_all;
    if (u.Decided() && !u.given_up && !ends_after_all) continue;
    const bool missed = g.sought && !(std::abs(g.Miss()) <= problem_.tolerance());
    u.status = missed ? Cycle::Status::kNotConverged : Cycle::Status::kConverged;
  }
  if (sight.exact && sight.time >= problem_.end()) problem_.groups.NoteCut(sight, problem_.end());
  return changed;
}

March::End March::Solve(bool rejected) {
  rejected_ = rejected;
  coarse_ = true;
  ahead_ = kSearch.ahead_miss;
  next_.reset();
  polished_.clear(), tries_.clear(), waited_.clear();
  TakeUp();
  growing_.Begin();
  Ids changed;
  for (int round = 0; round < kSearch.rounds; ++round) {
    const Sight sight = next_ ? *std::exchange(next_, {}) : Look(changed);
    if (problem_.Aborted() || sight.pause == Motion::Pause::kNumeric) {
      return {.pause = sight.pause};
    }
    changed = Note(sight);
    if (!changed.empty() && round < kSearch.rounds / 2) continue;
    const Timeline timeline = Read(sight);
    const GroupSight* miss = timeline.FirstMiss(ahead_);
    if (miss == nullptr && TakeUp()) continue;
    if (sight.exact &&
        timeline.FirstMiss(problem_.tolerance()) == miss) {  // All before it is solved.
      if (IsEnough(sight, miss)) {
        if (Reopens(sight, miss)) continue;
        return Recorded(sight, miss);
      }
    } else if (miss == nullptr) {  // All is solved ahead.
      if (const auto end = Polish(sight)) return *end;
      continue;
    }
    if (miss != nullptr) Advance(sight, *miss);
    if (problem_.Aborted()) return {.pause = problem_.pause()};
  }
  return {};
}

// Whether what is final before the first miss is worth a recording.
bool March::IsEnough(const Sight& sight, const GroupSight* miss) const {
  const double start = problem_.start_time();
  return miss == nullptr ||
         Read(sight).FinalUntil(miss) - start > kSearch.commit * (sight.time - start);
}

// Takes up again what was found to have no solution, or does not end; false: there is none.
bool March::Reopens(const Sight& sight, const GroupSight* miss) {
  const bool all = miss == nullptr && !sight.crowded;
  const double final = all ? kNever : Read(sight).FinalUntil(miss);
  const bool reopens = growing_.Reopen(sight, final) || (all && growing_.Close(sight));
  if (reopens) polished_.clear();
  return reopens;
}

March::End March::Recorded(const Sight& sight, const GroupSight* miss) const {
  const double start = problem_.start_time(), final = Read(sight).FinalUntil(miss);
  const bool all = miss == nullptr && !sight.crowded;
  if (all) return {.until = std::min(sight.time, problem_.end()), .sight = sight};
  if (final >= problem_.end()) return {.until = problem_.end(), .sight = sight};
  const double length = (final > start ? final : sight.time) - start;
  return {.until = start + (1 - kAtOnce) * length, .sight = sight};
}

// Whether what is polished is all up to the first instant at which no cycle runs.
bool March::MayBeAll(const Sight& sight) const {
  return !rejected_ && sight.pause == Motion::Pause::kQuiet && SeesAll(sight);
}

// Whether every group has ended for good.
bool March::SeesAll(const Sight& sight) {
  return !sight.crowded &&
         std::ranges::all_of(sight.groups, [](const auto& g) { return g.separated || !g.sought; });
}

// Solves all that was solved ahead to the scenario's tolerance.
std::optional<March::End> March::Polish(const Sight& sight) {
  const Timeline timeline = Read(sight);
  const Ids open = timeline.Solved(problem_.tolerance(), ahead_);
  const bool all = MayBeAll(sight);
  const auto worst = [&] {
    double most = 0;
    for (const GroupId& id : open) most = std::max(most, std::abs(sight.Find(id)->Miss()));
    return most;
  };
  const bool guessed = std::ranges::none_of(
      open, [&](const GroupId& id) { return problem_.groups.At(id).corrected; });
  if (all && guessed && worst() <= kSearch.noise) {
    return End{.until = problem_.end(), .tentative = true};
  }
  coarse_ = false;
  if (open.empty()) return {};
  const double goal = problem_.tolerance();
  const Newton::End end = SolveBlock(open, Has(open, sight) ? &sight : nullptr, goal,
                                     Precision::kExact, all ? kSearch.unseen * goal : 0);
  if (end == Newton::End::kUnseen) return End{.until = problem_.end(), .tentative = true};
  if (end == Newton::End::kLimit) GiveUp(open);
  if (end == Newton::End::kSolved) Settle(open);
  if (end == Newton::End::kStalled) SolveStrictly(open);
  return {};
}

// What is solved ahead to less may have no solution. Groups depend on those that end before them
// only, so more and more of them are solved, a few at once, up to the first because of which no
// step helps.
void March::SolveStrictly(const Ids& open) {
  std::size_t solved = 0;
  for (std::size_t few = kSearch.at_once; solved < open.size();) {
    const std::size_t next = std::min(solved + few, open.size());
    const Ids first(open.begin(), open.begin() + static_cast<std::ptrdiff_t>(next));
    const Newton::End end = SolveBlock(first, nullptr, problem_.tolerance(), Precision::kExact);
    if (end == Newton::End::kLimit) GiveUp(first);
    if (problem_.Aborted() || end == Newton::End::kLimit) return;
    if (end == Newton::End::kStalled && few == 1) break;
    if (end != Newton::End::kStalled) solved = next;
    few = end == Newton::End::kStalled ? 1 : few;
  }
  if (solved == open.size()) return;
  coarse_ = false;
  const Sight exact = Look();
  const GroupSight* miss = exact.Find(open[solved]);
  if (miss == nullptr || !problem_.groups.Misses(*miss, problem_.tolerance())) {
    miss = Read(exact).FirstMiss(problem_.tolerance());
  }
  if (problem_.Aborted() || miss == nullptr) return;
  SolveFirst(exact, *miss, problem_.tolerance(), Precision::kExact);
}

// A group is settled if what was solved since it was polished last has not moved its μ.
void March::Settle(const Ids& ids) {
  for (const GroupId& id : ids) {
    const double mu = problem_.groups.At(id).mu;
    Polished& polished = polished_[id];
    polished.settled = std::abs(mu - polished.mu) <= kSearch.influence * problem_.tolerance() * mu;
    polished.mu = mu;
  }
}

// Solves the first group that misses with what overlaps it, well enough to go on.
void March::Advance(const Sight& sight, const GroupSight& miss) {
  ahead_ = SeesAll(sight) ? kSearch.last_miss : kSearch.ahead_miss;
  SolveFirst(sight, miss, ahead_, Precision::kAhead);
  if (next_ == std::nullopt) coarse_ = true;
}

// Solves a group with what overlaps it, few of these at once if that helps; where that stalls it
// has its verdict.
void March::SolveFirst(const Sight& sight, const GroupSight& miss, double goal, Precision how) {
  const Timeline timeline = Read(sight);
  const Ids block = timeline.Block(miss, 0, kSearch.block);
  const Ids wide = timeline.Block(miss, kSearch.at_once, kSearch.block);
  const bool ahead = how == Precision::kAhead;
  for (const Ids& ids : block == wide ? std::vector<Ids>{block} : std::vector<Ids>{wide, block}) {
    const Sight* seen = sight.exact != ahead && Has(ids, sight) ? &sight : nullptr;
    blurs_ = false;
    const Newton::End end =
        SolveBlock(ids, seen, goal, how, 0, ahead && sight.exact ? &miss : nullptr);
    if (end == Newton::End::kLimit) GiveUp(ids);
    // With the same μ the two passes see other motions: to look again would go on without end.
    const bool unlike =
        ahead && end == Newton::End::kSolved && corrections_ == 0 && std::abs(miss.Miss()) > goal;
    if (problem_.Aborted() || (end != Newton::End::kStalled && !unlike)) return;
    if (blurs_) break;
  }
  if (blurs_) {
    const Newton::End end = SolveBlock(block, nullptr, goal, Precision::kExact);
    if (problem_.Aborted() || end != Newton::End::kStalled) return;
  }
  Verdict(miss, block, goal, how);
}

// Whether this pass has the slopes of a block.
bool March::Has(const Ids& ids, const Sight& sight) const {
  return std::ranges::all_of(ids, [&](const GroupId& id) {
    const GroupSight* g = sight.Find(id);
    return g != nullptr && g->ended && g->column != kNone && g->gradient.size() > 0;
  });
}

// Whether a coarse pass does not show what an exact one has shown with the same μ.
bool March::Blurs(const Sight& coarse, const GroupSight& exact, double goal) {
  const GroupSight* g = coarse.Find(exact.id);
  if (g == nullptr || !g->ended || g->weak) return true;
  return !(std::abs(g->Miss()) > goal && std::abs(g->Miss() / exact.Miss() - 1) < kSearch.alike);
}

Newton::End March::SolveBlock(const Ids& ids, const Sight* seen, double goal, Precision precision,
                              double unseen, const GroupSight* shown) {
  const bool ahead = precision == Precision::kAhead;
  coarse_ = ahead;
  next_.reset();
  Block block(problem_, log_, ids, ahead, ahead_);
  const Eigen::VectorXd before = block.Mu();
  std::vector<bool> corrected;
  for (const GroupId& id : ids) corrected.push_back(problem_.groups.At(id).corrected);
  Residuals::Value value = seen != nullptr ? block.Begin(*seen) : block.Begin();
  int most =
      problem_.scenario().solver.max_iterations - (ahead ? 0 : std::exchange(corrections_, 0));
  const bool leads = seen != nullptr && !seen->exact && !ahead && value.valid;
  if (leads && most-- <= 0) return Newton::End::kLimit;
  if (leads) {  // What is coarse leads to where it is exact.
    block.Set(block.Moved(before, Newton::Step(value)));
    block.OnStep(1);
    value = block.Begin();
  }
  if (problem_.Aborted()) return Newton::End::kAborted;
  if (shown != nullptr && Blurs(block.last(), *shown, goal)) {
    blurs_ = true;
    return Newton::End::kStalled;
  }
  if (!value.valid) return Newton::End::kStalled;
  Newton newton(block);
  Eigen::VectorXd mu = block.Mu();
  const NewtonOptions options{.goal = goal,
                              .most_steps = most,
                              .slopes_at_once = ids.size() <= kSearch.at_once,
                              .most_trials = kSearch.trials,
                              .limited = true,
                              .blind = unseen};
  const Newton::End end = newton.Solve(options, std::move(value), &mu);
  if (ahead) corrections_ = newton.steps();
  if (end != Newton::End::kStalled) block.Set(mu);
  if (end == Newton::End::kSolved) {
    Freeze(ids, block.last());
    next_ = std::move(block.last());
  }
  if (end == Newton::End::kStalled) {
    for (std::size_t i = 0; i < ids.size(); ++i) {
      Unknown& unknown = problem_.groups.At(ids[i]);
      unknown.mu = before[static_cast<Eigen::Index>(i)];
      unknown.corrected = corrected[i];
    }
  }
  return end;
}

// What was guessed of groups that overlap a solved block stays as it is, unless it is poor: to
// guess anew undoes the solution.
void March::Freeze(const Ids& ids, const Sight& sight) {
  double end = 0;
  for (const GroupId& id : ids) {
    if (const GroupSight* g = sight.Find(id)) end = std::max(end, g->end_time);
  }
  for (auto& [id, unknown] : problem_.groups.known()) unknown.kept |= unknown.start_time < end;
}

// The block of a group stalls: what the group alone comes to, with all others held, decides.
void March::Verdict(const GroupSight& seen, const Ids& ids, double goal, Precision how) {
  const Sight sight = problem_.Evaluate(ids, false, kNever);
  if (problem_.Aborted()) return;
  const GroupSight* found = sight.Find(seen.id);
  const GroupSight group = found != nullptr && found->ended ? *found : seen;
  const Root root = bisection_.Solve(group, goal);
  if (problem_.Aborted()) return;
  if (root == Root::kFound && tries_[group.id]++ < kSearch.tries) {
    SolveBlock(ids, nullptr, goal, how);
  } else {
    Grow(group, root, sight);
  }
}

// A group that has no root may have one when what overlaps it is no mere guess any more: it then
// waits until that is solved, once. Not where it may grow, for what is solved around a group that
// is too short is lost when it grows: 1.8 times the steps of AUTO, and 13 of 1,800 runs.
bool March::Waits(const GroupSight& group, const Sight& sight) {
  const bool guessed = std::ranges::any_of(sight.groups, [&](const GroupSight& g) {
    const Unknown& u = problem_.groups.At(g.id);
    return g.id != group.id && g.sought && !g.weak && !u.corrected && !u.Decided() &&
           g.start_time < group.end_time && (!g.ended || g.end_time > group.end_time);
  });
  if (!guessed || !waited_.insert(group.id).second) return false;
  problem_.groups.At(group.id).waits = true;
  coarse_ = true;
  return true;
}

// Takes up what waits, for nothing else misses.
bool March::TakeUp() {
  bool any = false;
  for (auto& [id, unknown] : problem_.groups.known()) any |= std::exchange(unknown.waits, false);
  return any;
}

// A group that has no root with what is around it grows, waits, or is said what it is; so does one
// of which the roots led to no solution of its block.
void March::Grow(const GroupSight& group, Root root, const Sight& sight) {
  coarse_ = true;
  if (root != Root::kFound && !growing_.Answer(group, root)) {
    if (problem_.Aborted() || Waits(group, sight)) return;
    growing_.Decide(group.id, root);
  }
  if (root == Root::kFound) growing_.Force(group.id);
  tries_.clear(), polished_.clear();
  std::erase_if(waited_, [&](const GroupId& id) { return !problem_.groups.At(id).waits; });
}

// As many corrections as are allowed did not solve the block: those that miss keep what they have.
void March::GiveUp(const Ids& ids) {
  const Sight sight = problem_.Evaluate(ids, false, kNever);
  for (const GroupId& id : ids) {
    const GroupSight* g = sight.Find(id);
    if (g != nullptr && problem_.groups.Misses(*g, problem_.tolerance())) {
      problem_.groups.At(id).given_up = true;
    }
  }
}

}  // namespace contact
