#include "simulation/episode/episode.h"

#include <algorithm>
#include <cmath>

#include "simulation/episode/run_state.h"

namespace contact {
namespace {

// A stretch that the paper's process takes as one episode has at most so many cycles.
constexpr int kPaperCycles = 120;
// The tolerance to which an episode is solved once its recording has denied what was found with the
// scenario's: weak cycles beside much larger motions have lost their digits. The least of the
// contract. Of 3,100 machines 7 more are FULL (Machines.AreSolvedFinely…).
constexpr double kFinestTolerance = 1e-13;

}  // namespace

EpisodeSolver::EpisodeSolver(const Scenario& scenario, Motion& motion, Observer& observer)
    : scenario_(scenario),
      motion_(motion),
      problem_(scenario, motion, observer),
      log_(observer),
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
  state->record_until = record_until_;
  state->finely = finely_;
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
  record_until_ = state.record_until;
  finely_ = state.finely;
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
  const bool begins = episode != episode_;
  if (begins) {
    problem_.groups.ForgetBegun(start);
    log_.Begin(episode, start.time);
    rejected_ = false;
  }
  episode_ = episode;
  bool sought = false;
  for (int c = 0; c < std::ssize(scenario_.contacts); ++c) sought |= IsSought(scenario_, c);
  tentative_ = false;
  const bool solved = start.time < solved_until_ && !Wakes(start);
  if (!solved) record_until_ = end;
  if (!solved && begins) finely_ = false;
  motion_.set_finest(finely_ ? kFinestTolerance : scenario_.solver.relative_tolerance);
  if (!sought || solved) return Motion::Pause::kQuiet;
  problem_.Begin(start, end, stop, step_limit);
  if (scenario_.solver.update != UpdateRule::kNewtonCoupled) {
    paper_.Solve(kPaperCycles, scenario_.solver.max_iterations);
    return problem_.Aborted() ? problem_.pause() : Motion::Pause::kQuiet;
  }
  const March::End found = march_.Solve(rejected_);
  tentative_ = found.tentative;
  if (!tentative_ && found.pause == Motion::Pause::kQuiet && found.until < kNever) {
    Accept(found.sight, found.until);
  }
  return found.pause;
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

// What begins before `until` has its answer. Where the pass paused for itself, so will the
// recording: told to end there, it may end a rounding before the event, and that again and again.
void EpisodeSolver::Accept(const Sight& sight, double until) {
  const bool pauses = sight.pause == Motion::Pause::kQuiet && until >= sight.time;
  if (until < problem_.end() && !pauses) record_until_ = until;
  solved_until_ = until - kAtOnce * (until - problem_.start_time());
  log_.Accept(sight);
}

// Steps of fixed length know no tolerance, and one that is coarser than the default is what the
// user wants to see.
bool EpisodeSolver::MayBeFiner() const {
  const SolverOptions& options = scenario_.solver;
  return !finely_ && options.fixed_step == 0 && options.relative_tolerance > kFinestTolerance &&
         options.relative_tolerance <= SolverOptions{}.relative_tolerance &&
         options.update == UpdateRule::kNewtonCoupled;
}

bool EpisodeSolver::Accepts(Motion::Pause pause) {
  const bool broken = pause == Motion::Pause::kStopped || pause == Motion::Pause::kStepLimit;
  const bool complete = pause == Motion::Pause::kQuiet && problem_.IsOpen();
  const bool holds =
      tentative_ ? complete && recorder_.sound() : !recorder_.denies() || !MayBeFiner();
  if (broken || holds) {
    if (tentative_) log_.Accept(recorder_.groups);
    recorder_.TellFaults();
    return true;
  }
  if (!tentative_) finely_ = true, solved_until_ = 0;
  rejected_ = true;
  return false;
}

}  // namespace contact
