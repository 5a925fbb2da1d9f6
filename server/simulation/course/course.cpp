#include "simulation/course/course.h"

#include <utility>

#include "simulation/episode/run_state.h"

namespace contact {

Course::Course(const Scenario& scenario, Observer& observer, std::stop_token stop)
    : scenario_(scenario),
      stop_(std::move(stop)),
      motion_(scenario),
      solver_(scenario, motion_, observer) {}

Motion::Pause Course::Record(const State& start, double until, std::int64_t step_limit,
                             Recording& recording) {
  motion_.Begin(start, true);
  return motion_.Advance(until, solver_.Record(solver_.tentative()), &recording, stop_, step_limit);
}

Course::Stretch Course::Episode(const State& start, int number, std::int64_t step_limit,
                                Recording& recording) {
  while (true) {
    const Motion::Pause solved =
        solver_.Solve(start, number, scenario_.end_time, stop_, step_limit);
    if (solved != Motion::Pause::kQuiet) return {.pause = solved};
    if (solver_.MayBeRejected()) recording.Hold();
    const Motion::Pause pause = Record(start, solver_.record_until(), step_limit, recording);
    if (solver_.Accepts(pause)) {
      recording.Release();
      return {.pause = pause, .recorded = true};
    }
    recording.TakeBack();
  }
}

// Once it is known where rests end on the way. One that ends at once begins an episode instead.
Course::Stretch Course::Flight(const State& start, double until, std::int64_t step_limit,
                               Recording& recording) {
  motion_.set_finest(scenario_.solver.relative_tolerance);
  const Motion::Pause foreseen = solver_.Foresee(start, until, stop_, step_limit);
  if (foreseen != Motion::Pause::kQuiet) return {.pause = foreseen};
  if (solver_.Wakes(start)) return {};
  motion_.Begin(start, true);
  return {.pause = motion_.Advance(until, solver_.Record(false), &recording, stop_, step_limit),
          .recorded = true};
}

Motion::Pause Course::Look(const State& start, double until, std::int64_t step_limit,
                           StepListener& listener) {
  motion_.set_finest(scenario_.solver.relative_tolerance);
  motion_.Begin(start, true);
  return motion_.Advance(until, solver_.Record(false), &listener, stop_, step_limit);
}

void Course::Save(RunState* state) const {
  state->steps = motion_.steps();
  state->evaluations = motion_.evaluations();
  solver_.Save(state);
}

void Course::Restore(const RunState& from) {
  motion_.Restore(from.steps, from.evaluations);
  solver_.Restore(from);
}

}  // namespace contact
