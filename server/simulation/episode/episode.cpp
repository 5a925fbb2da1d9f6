#include "simulation/episode/episode.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "simulation/episode/front.h"
#include "simulation/episode/run_state.h"

namespace contact {
namespace {

// Bisections between which Newton's method begins anew, first of the group because of which it has
// stalled, then of all groups of a front, one by one; after as many the front makes no progress.
constexpr int kSweeps = 5;
// Fronts may take turns without end, where one that is solved brings back another: so many stalls
// since a group has grown, was decided or the window has, are no progress either.
constexpr int kStalls = 10;
// Rounds of the search in an episode: each solves a front, grows a group or gives one up.
constexpr int kRounds = 500;
// Instants so near, relative to the episode, are one: round-off parts them.
constexpr double kAtOnce = 1e-9;
// A group found unfinished that others let end after all is sought again, so often at most.
constexpr int kReopened = 3;
// Scans in a row in which negligible groups come and go.
constexpr int kRescans = 5;
// A miss by which a guess is poor, so that the search begins with the earliest part of the front,
// and one that is good enough for the next part.
constexpr double kPoor = 0.02, kGood = 1e-3;
// Relative error of passes that only look, and a miss that they can tell.
constexpr double kCoarse = 1e-6, kNear = 1e-4;
// What was left out of a part acts back on it if the part, solved so often in a row, misses again.
constexpr int kUndone = 2;
// A group that began compressed and misses by more than this may be there only because others miss;
// of fronts of a few groups all are solved at once.
constexpr double kAstray = 0.5;
constexpr std::size_t kFew = 6;
// A miss that may be the error of the first, coarse look: it sees an isolated collision, whose
// guess is exact, miss by 1.02e-6 at ε = 0.9. The recording tells whether it is more.
constexpr double kNoise = 3e-6;
// A stretch that the paper's process takes as one episode has at most so many cycles.
constexpr int kPaperCycles = 120;

// Whether no group ends where the next of its encounter begins, which may want to join it.
bool IsApart(const Sight& sight) {
  return std::ranges::all_of(sight.groups,
                             [](const GroupSight& g) { return g.separated || !g.sought; });
}

bool Within(const std::vector<GroupId>& front, const Sight& sight, double miss) {
  return std::ranges::all_of(
      front, [&](const GroupId& id) { return std::abs(sight.Find(id)->Miss()) <= miss; });
}

// Those of these groups that begin an encounter or miss by little, if one of them misses by more
// than `miss`; else all.
std::vector<GroupId> WithoutAstray(const std::vector<GroupId>& groups, const Sight& sight,
                                   double miss) {
  std::vector<GroupId> rest;
  for (const GroupId& id : groups) {
    if (id.place == 1 || std::abs(sight.Find(id)->Miss()) < kAstray) rest.push_back(id);
  }
  return groups.size() <= kFew || Within(rest, sight, miss) ? groups : rest;
}

// Groups of which an earlier search has found the answer. It may have seen many more, with guesses.
int Answered(const Groups& groups) {
  return static_cast<int>(std::ranges::count_if(groups.known(), [](const auto& entry) {
    const Unknown& u = entry.second;
    return (u.corrected || u.kept) && (u.Decided() || u.status == Cycle::Status::kConverged);
  }));
}

// Whether the march takes the place of fronts.
bool Marches() {
  static const bool marches = std::getenv("CONTACT_MARCH") != nullptr;
  return marches;
}

}  // namespace

EpisodeSolver::EpisodeSolver(const Scenario& scenario, Motion& motion, Observer& observer)
    : scenario_(scenario),
      problem_(scenario, motion, observer),
      log_(observer),
      newton_(problem_, log_),
      bisection_(problem_),
      growing_(problem_, log_, bisection_),
      march_(problem_, log_, growing_, bisection_),
      paper_(problem_, log_),
      recorder_(scenario, motion, observer, problem_.groups) {}

void EpisodeSolver::Save(RunState* state) const {
  state->iterations = log_.total;
  state->growths = log_.growths;
  state->growths_no_progress = log_.growths_no_progress;
  state->solved_until = solved_until_;
  state->cut_since = problem_.groups.cut_since();
  state->unknowns.clear();
  for (const auto& [id, unknown] : problem_.groups.known()) state->unknowns.push_back(unknown);
  state->rest_ends.clear();
  for (const auto& [id, time] : problem_.groups.rest_ends()) state->rest_ends.push_back({id, time});
  recorder_.Save(state);
}

void EpisodeSolver::Restore(const RunState& state) {
  log_.total = state.iterations;
  log_.growths = state.growths;
  log_.growths_no_progress = state.growths_no_progress;
  solved_until_ = state.solved_until;
  problem_.groups.set_cut_since(state.cut_since);
  for (const Unknown& unknown : state.unknowns) problem_.groups.At(unknown.id) = unknown;
  for (const auto& [id, time] : state.rest_ends) problem_.groups.NoteRestEnd(id, time);
  recorder_.Restore(state);
  episode_ = static_cast<int>(state.outcome.episodes);  // Of cycles that rest after it.
}

Recorder& EpisodeSolver::Record(bool repeatable) {
  recorder_.Begin(episode_, repeatable);
  return recorder_;
}

Motion::Pause EpisodeSolver::Solve(const State& start, int episode, double end,
                                   const std::stop_token& stop, std::int64_t step_limit) {
  if (episode != episode_) {
    problem_.groups.ForgetBegun(start);
    log_.Begin(episode, start.time);
    rejected_ = false;
  }
  episode_ = episode;
  bool sought = false;
  for (int c = 0; c < std::ssize(scenario_.contacts); ++c) sought |= IsSought(scenario_, c);
  record_until_ = end;
  tentative_ = false;
  const bool solved = start.time < solved_until_ && !Wakes(start);
  if (!sought || solved) return Motion::Pause::kQuiet;
  problem_.Begin(start, end, stop, step_limit);
  if (scenario_.solver.update != UpdateRule::kNewtonCoupled) {
    const Found found = paper_.Solve(kPaperCycles, scenario_.solver.max_iterations);
    return found == Found::kAborted ? problem_.pause() : Motion::Pause::kQuiet;
  }
  if (Marches()) return MarchOn();
  const auto running = static_cast<int>(std::ranges::count_if(
      start.contacts, [](const ContactState& c) { return c.phase == Phase::kRestitution; }));
  window_.Begin(start.time, running, Answered(problem_.groups),
                static_cast<int>(scenario_.contacts.size()),
                scenario_.solver.restitution_scope == RestitutionScope::kEncounter
                    ? scenario_.solver.encounter_cycles
                    : 1);
  return Search();
}

Motion::Pause EpisodeSolver::Foresee(const State& start, double end, const std::stop_token& stop,
                                     std::int64_t step_limit) {
  if (std::ranges::none_of(start.contacts, Rests)) return Motion::Pause::kQuiet;
  problem_.Begin(start, end, stop, step_limit);
  const Motion::Pause pause = problem_.SeeFlight();
  const bool completed = !problem_.Aborted() && pause != Motion::Pause::kNumeric;
  return completed ? Motion::Pause::kQuiet : pause;
}

bool EpisodeSolver::Wakes(const State& state) const {
  return std::ranges::any_of(state.contacts, [&](const ContactState& c) {
    return Rests(c) && problem_.groups.RestEnd(LastGroup(c)) <= state.time;
  });
}

// A scan, of which what it tells of each group is noted; again where a group has become negligible,
// or is no more, for that changes its μ.
Sight EpisodeSolver::Scan(bool coarse) {
  for (int i = 0;; ++i) {
    Sight sight = problem_.Scan(window_.cycles(), guessing_, coarse);
    bool changed = false;
    for (const GroupSight& g : sight.groups) {
      Unknown& unknown = problem_.groups.At(g.id);
      unknown.cut = !g.ended || g.end_time > problem_.end();
      if (!g.ended) continue;
      const bool flips = g.sought && unknown.weak != g.weak;
      changed |= flips;
      unknown.flips += flips;
      unknown.weak = g.weak;
      unknown.restitution_out = std::sqrt(std::max(g.squared, 0.0));
      if (unknown.length == 0) unknown.length = g.length, unknown.speed = g.speed;
      const bool ends_after_all = unknown.status == Cycle::Status::kUnfinished &&
                                  g.end_time <= problem_.end() && unknown.reopened < kReopened;
      if (ends_after_all) ++unknown.reopened;
      if (unknown.Decided() && !unknown.given_up && !ends_after_all) continue;
      const bool missed = g.sought && !(std::abs(g.Miss()) <= problem_.tolerance());
      unknown.status = missed ? Cycle::Status::kNotConverged : Cycle::Status::kConverged;
    }
    if (sight.time >= problem_.end()) problem_.groups.NoteCut(sight, problem_.end());
    if (!changed || i == kRescans || problem_.Aborted()) return sight;
  }
}

Motion::Pause EpisodeSolver::MarchOn() {
  const March::End end = march_.Solve(rejected_);
  tentative_ = end.tentative;
  if (!tentative_ && end.pause == Motion::Pause::kQuiet && end.until < kNever) {
    return Record(end.sight, end.until);
  }
  return end.pause;
}

Motion::Pause EpisodeSolver::Search() {
  sweeps_ = stalls_ = 0;
  guessing_ = true;
  solved_.clear();
  unsolved_ = 0;
  growing_.Begin();
  for (int round = 0; round < kRounds; ++round) {
    const bool first = round == 0 && !rejected_;
    const Sight sight = Scan(first);
    if (problem_.Aborted() || sight.pause == Motion::Pause::kNumeric) return sight.pause;
    const std::vector<GroupId> front =
        Front(sight, problem_.groups, problem_.tolerance(), problem_.end());
    if (!front.empty()) {
      if (const double final = first ? 0 : LastFinal(sight, front); final > problem_.start_time()) {
        if (growing_.Reopen(sight, final)) continue;
        return Record(sight, final);
      }
      const bool may_be_all = !rejected_ && !sight.crowded && IsApart(sight);
      if (first && may_be_all && Within(front, sight, kNoise)) return Tentatively();
      const Found found = SolveFront(sight, front);
      if (found == Found::kAborted) return problem_.pause();
      if (found == Found::kSolved && may_be_all) return Tentatively();
      continue;
    }
    if (first) {
      if (!sight.crowded && !sight.quiet.empty() && IsApart(sight)) return Tentatively();
      continue;
    }
    if (growing_.Reopen(sight)) continue;
    if (!sight.crowded && growing_.Close(sight)) continue;
    const double final =
        window_.FinalUntil(sight, problem_.groups, problem_.tolerance(), problem_.end());
    guessing_ = true;
    stalls_ = 0;
    if (final > problem_.start_time()) return Record(sight, final);
    // The window has grown.
  }
  return Motion::Pause::kQuiet;
}

// What begins before `until` has its answer. Where the pass paused for itself, so will the
// recording: told to end there, it may end a rounding before the event, and that again and again.
Motion::Pause EpisodeSolver::Record(const Sight& sight, double until) {
  const bool pauses = sight.pause == Motion::Pause::kQuiet && until >= sight.time;
  if (until < problem_.end() && !pauses) record_until_ = until;
  solved_until_ = until - kAtOnce * (until - problem_.start_time());
  log_.Accept(sight);
  return Motion::Pause::kQuiet;
}

// All up to the first instant at which no cycle runs seems to be solved: its recording will tell.
Motion::Pause EpisodeSolver::Tentatively() {
  tentative_ = true;
  return Motion::Pause::kQuiet;
}

bool EpisodeSolver::Accepts(Motion::Pause pause) {
  if (!tentative_) return true;
  const bool complete = pause == Motion::Pause::kQuiet && problem_.IsOpen();
  const bool broken = pause == Motion::Pause::kStopped || pause == Motion::Pause::kStepLimit;
  if (broken || (complete && recorder_.sound())) {
    log_.Accept(recorder_.groups);
    return true;
  }
  rejected_ = true;
  return false;
}

Found EpisodeSolver::SolveFront(const Sight& sight, const std::vector<GroupId>& front) {
  const std::vector<GroupId> part = EarliestPart(front, sight, kPoor);
  guessing_ = !part.empty();
  std::vector<GroupId> now = WithoutAstray(part.empty() ? front : part, sight, kGood);
  const bool unsolved = now == solved_;  // As a scan has seen it after all.
  unsolved_ = unsolved ? unsolved_ + 1 : 0;
  if (unsolved) problem_.Distrust();
  if (unsolved_ > kUndone) now = now.size() < part.size() ? part : front;
  const bool whole = now.size() == front.size();
  const double goal = whole ? problem_.tolerance() : kGood;
  const int most = scenario_.solver.max_iterations;
  const bool again = unsolved || (now.front() == last_ && sweeps_ > 1);
  Found found = newton_.Solve(now, goal, most, !again, sight);
  if (found == Found::kSolved && newton_.corrections() == 0) {  // A coarse pass sees what is not.
    found = newton_.Solve(front, problem_.tolerance(), most, false, sight);
    if (found == Found::kSolved && newton_.corrections() == 0) found = Found::kStalled;
  }
  if (found == Found::kSolved) solved_ = now;
  if (found == Found::kSolved && !whole) return Found::kStalled;  // The rest is still to be solved.
  if (found == Found::kSolved) Freeze(sight, front);
  if (found == Found::kSolved || found == Found::kAborted) return found;
  if (found == Found::kLimit) {
    GiveUp(sight, now);
    return found;
  }
  if (now.front() != last_) sweeps_ = 0;
  last_ = now.front();
  if (sweeps_ == kSweeps || ++stalls_ > kStalls) {
    sweeps_ = stalls_ = 0;
    growing_.Force(now);
  } else {
    const bool one = sweeps_ == 0 && !newton_.suspect().empty();
    const bool answered = one ? BisectSuspect(sight, now) : Bisect(sight, now);
    sweeps_ = answered ? 0 : sweeps_ + 1;
    if (answered) stalls_ = 0;
  }
  return problem_.Aborted() ? Found::kAborted : Found::kStalled;
}

// What was guessed of groups that overlap a front which is solved stays as it is, if it is not
// poor: to guess anew undoes the solution.
void EpisodeSolver::Freeze(const Sight& sight, const std::vector<GroupId>& front) {
  double end = 0;
  for (const GroupId& id : front) end = std::max(end, sight.Find(id)->end_time);
  for (auto& [id, unknown] : problem_.groups.known()) {
    if (unknown.start_time < end) unknown.kept = true;
  }
}

// One unknown at a time, in the order of time. Whether a group has grown or was decided.
bool EpisodeSolver::Bisect(const Sight& sight, const std::vector<GroupId>& front) {
  Sight now = problem_.Evaluate(front, false, kForever, kCoarse);
  for (const GroupId& id : front) {
    if (problem_.Aborted()) return true;
    const GroupSight* seen = now.Find(id);
    const GroupSight group = seen != nullptr && seen->ended ? *seen : *sight.Find(id);
    if (group.weak || std::abs(group.Miss()) <= kNear) continue;
    const Root root = bisection_.Solve(group, !Grows());
    if (root == Root::kAborted) return true;
    if (root != Root::kFound) return Answer(group, root);
    now = problem_.Evaluate(front, false, kForever, kCoarse);
  }
  return false;
}

// The group because of which Newton's method has stalled. What gives back too much may do so
// because others miss: that is left to a sweep, and so is a root that changes nothing.
bool EpisodeSolver::BisectSuspect(const Sight& sight, const std::vector<GroupId>& front) {
  const GroupId id = newton_.suspect().front();
  const Sight now = problem_.Evaluate({id}, false, kForever, kCoarse);
  const GroupSight* seen = now.Find(id);
  const GroupSight group = seen != nullptr && seen->ended ? *seen : *sight.Find(id);
  if (group.weak || problem_.Aborted()) return problem_.Aborted();
  const Root root = bisection_.Solve(group, !Grows());
  if (root == Root::kFound) return false;
  const auto misses = [&](const GroupId& other) {
    const GroupSight* g = now.Find(other);
    return other != id && g != nullptr && g->ended && std::abs(g->Miss()) > kGood;
  };
  const bool others = front.size() <= kFew || std::ranges::any_of(front, misses);
  if (root == Root::kTooMuch && others) return Bisect(sight, front);
  return root == Root::kAborted || Answer(group, root);
}

bool EpisodeSolver::Grows() const {
  return scenario_.solver.restitution_scope != RestitutionScope::kCycle;
}

// A group without a root grows, or it is said what it is. A jump is then to be told sharply.
bool EpisodeSolver::Answer(const GroupSight& group, Root root) {
  if (growing_.Answer(group, root)) return true;
  if (Grows() && root == Root::kJump) root = bisection_.Solve(group, true);
  if (root != Root::kFound && root != Root::kAborted) growing_.Decide(group.id, root);
  return true;
}

// As many corrections as are allowed did not solve the front: those that miss keep what they have.
void EpisodeSolver::GiveUp(const Sight& sight, const std::vector<GroupId>& front) {
  const Sight now = problem_.Evaluate(front, false, 1e300);
  for (const GroupId& id : front) {
    const GroupSight* seen = now.Find(id);
    const GroupSight* g = seen != nullptr && seen->ended ? seen : sight.Find(id);
    if (Misses(*g, problem_.groups, problem_.tolerance())) problem_.groups.At(id).given_up = true;
  }
}

}  // namespace contact
