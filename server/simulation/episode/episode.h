#pragma once

#include <stop_token>

#include "simulation/episode/bisection.h"
#include "simulation/episode/growing.h"
#include "simulation/episode/march.h"
#include "simulation/episode/paper_search.h"
#include "simulation/episode/recorder.h"

namespace contact {

struct RunState;

/// Finds the μ of the groups of an episode by a march, or as the paper does, and judges by the
/// recording whether it is solved. README.md, "Finding μ".
class EpisodeSolver {
 public:
  EpisodeSolver(const Scenario& scenario, Motion& motion, Observer& observer);

  /// Takes up the episode that begins at `start` in a run to `end`, and solves it. Returns why a
  /// pass could not be completed, or kQuiet.
  Motion::Pause Solve(const State& start, int episode, double end, const std::stop_token& stop,
                      std::int64_t step_limit);

  /// Looks at the flight that begins at `start`, when no cycle runs: sees where rests end in it.
  /// Returns why that could not be completed, or kQuiet.
  Motion::Pause Foresee(const State& start, double end, const std::stop_token& stop,
                        std::int64_t step_limit);
  /// Whether a rest is known to end no later than in this state.
  bool Wakes(const State& state) const;
  /// The instant up to which the episode may be recorded, if it does not end before.
  double record_until() const { return record_until_; }
  /// Whether what is recorded has yet to show that the episode is solved.
  bool tentative() const { return tentative_; }
  /// Whether what is recorded may have to be recorded anew, as Accepts says.
  bool MayBeRejected() const { return tentative_ || MayBeFiner(); }
  /// Looks at the recording, which has ended for this reason. False: the episode is to be solved
  /// again, and recorded anew; with the finest tolerance, if the recording denies a group that was
  /// not tentative.
  bool Accepts(Motion::Pause pause);

  /// Begins the recording of the episode, or of the flight after it; hosts it. `repeatable`: see
  /// Recorder::Begin.
  Recorder& Record(bool repeatable);
  Recorder& recorder() { return recorder_; }

  void Save(RunState* state) const;
  void Restore(const RunState& state);
  const IterationLog& log() const { return log_; }

 private:
  void Accept(const Sight& sight, double until);
  bool MayBeFiner() const;

  const Scenario& scenario_;
  Motion& motion_;
  Problem problem_;
  IterationLog log_;
  Bisection bisection_;
  Growing growing_;
  March march_;
  PaperSearch paper_;
  Recorder recorder_;
  int episode_ = 0;
  double solved_until_ = 0;  // All that begins before has its answer.
  double record_until_ = kNever;
  bool finely_ = false;  // The episode is solved and recorded with the finest tolerance.
  bool tentative_ = false;
  bool rejected_ = false;  // A recording has shown that the episode is not solved.
};

}  // namespace contact
