#pragma once

#include <cstdint>
#include <stop_token>

#include "simulation/episode/episode.h"
#include "simulation/motion/motion.h"

namespace contact {

/// Hears of the steps of a recording, of which the last may be taken back.
class Recording : public StepListener {
 public:
  /// The steps from now on count once Release is called.
  virtual void Hold() = 0;
  /// The steps since Hold, if any, count.
  virtual void Release() = 0;
  /// The steps since Hold have never been.
  virtual void TakeBack() = 0;
};

/// Takes a scenario from episode to episode: solves what comes next, and records it.
class Course {
 public:
  /// Why a stretch has ended, and whether it was recorded. One that was not leaves the state as it
  /// is; if it is quiet then, an episode comes next.
  struct Stretch {
    Motion::Pause pause = Motion::Pause::kQuiet;
    bool recorded = false;
  };

  /// Scenario and observer outlive the course.
  Course(const Scenario& scenario, Observer& observer, std::stop_token stop);

  /// Whether an episode begins in this state, and no flight.
  bool EpisodeIsNext(const State& state) const { return InCycle(state) || solver_.Wakes(state); }
  /// The episode that begins at `start`, the one of this number, up to where it is solved.
  Stretch Episode(const State& start, int number, std::int64_t step_limit, Recording& recording);
  /// The flight that begins at `start`: to the next touch, or to `until` [s].
  Stretch Flight(const State& start, double until, std::int64_t step_limit, Recording& recording);

  /// About how it goes on from `start`, with what is only guessed of the cycles to come: until none
  /// runs, or to `until` [s]. Nothing of it counts.
  Motion::Pause Look(const State& start, double until, std::int64_t step_limit,
                     StepListener& listener);

  Motion& motion() { return motion_; }
  const Motion& motion() const { return motion_; }
  /// Holds the cycles and groups that have ended in the last stretch that was recorded.
  Recorder& recorder() { return solver_.recorder(); }
  const IterationLog& log() const { return solver_.log(); }

  void Save(RunState* state) const;
  void Restore(const RunState& from);

 private:
  Motion::Pause Record(const State& start, double until, std::int64_t step_limit,
                       Recording& recording);

  const Scenario& scenario_;
  const std::stop_token stop_;
  Motion motion_;
  EpisodeSolver solver_;
};

}  // namespace contact
