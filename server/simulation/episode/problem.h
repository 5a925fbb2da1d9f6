#pragma once

#include <cstdint>
#include <map>
#include <stop_token>
#include <tuple>
#include <vector>

#include "simulation/episode/pass.h"

namespace contact {

/// The equations that a search solves: of a block of groups, the residuals at given μ and their
/// slopes, in one pass through the motion.
class Problem {
 public:
  Problem(const Scenario& scenario, Motion& motion, Observer& observer);

  /// Passes begin at `start`, which must outlive them. The run ends at `end` [s].
  void Begin(const State& start, double end, const std::stop_token& stop, std::int64_t step_limit);

  /// Sees the first stretch without pause, each cycle of it.
  Sight SeeStretch(int most_cycles);
  /// How a pass of the march is made.
  struct Marching {
    std::vector<GroupId> since = {};  ///< Nothing before these has changed. Empty: the block.
    bool slopes = false;  ///< With slopes by the μ of the block, or if `wide` of all groups.
    bool wide = false;
    double until = 1e300;        ///< What of the block has not ended then is open [s].
    double tolerance = 0;        ///< Of the integration; 0: the scenario's, which is the finest.
    double miss = 0;             ///< It goes on to the next group that misses by more than this.
    double guess_from = kNever;  ///< What begins no earlier is guessed anew [s].
  };
  /// A pass from the start through the ends of a block to the next group that misses.
  Sight March(const std::vector<GroupId>& block, const Marching& how);
  /// Sees the flight until a cycle begins, at most to the end of the run.
  Motion::Pause SeeFlight();
  /// The block with the μ that its groups now have. `until`: what has not ended then is open [s].
  /// `tolerance`: of the integration; 0: the scenario's, which is the finest.
  Sight Evaluate(const std::vector<GroupId>& block, bool sensitive, double until,
                 double tolerance = 0);

  /// The largest μ [N·s/mⁿ⁺¹] that a group, as a pass has seen it, can feel: beyond it nothing
  /// turns any more.
  double MostMu(const GroupSight& group) const;

  /// Whether the run was stopped or has spent its steps: no pass means anything any more.
  bool Aborted() const { return aborted_; }
  /// Whether no contact is about to begin a cycle.
  bool IsOpen() const { return pass_.IsOpen(); }
  Motion::Pause pause() const { return pause_; }
  double start_time() const { return start_->time; }
  double end() const { return end_; }
  double tolerance() const { return scenario_.solver.restitution_tolerance; }
  const Scenario& scenario() const { return scenario_; }
  const Motion& motion() const { return motion_; }
  std::int64_t passes() const { return passes_; }

  Groups groups;

 private:
  // What was known of a group when a state was kept.
  using Held = std::tuple<GroupId, double, double, bool>;
  // A state shortly before the last block, if all that begins before is still what is held, and
  // what led to it. It is empty where none is kept.
  struct Kept {
    State state;
    std::vector<Held> held;
    Sight led;
  };
  Sight Look(const Kept* from, Pass::Plan plan);
  const Kept* Before(const std::vector<GroupId>& block, double tolerance);
  bool IsGuessed(const Sight& sight) const;
  std::vector<Held> HeldIn(const State& state) const;
  double Tolerance(double wanted) const;

  const Scenario& scenario_;
  Motion& motion_;
  Pass pass_;
  const bool swings_;  // Whether a load or a drive is a sine.
  const State* start_ = nullptr;
  Kept coarse_, exact_;  // Of passes that go ahead, and others: they may see other cycles.
  std::map<GroupId, double> begun_;  // Earlier starts [s] of groups than other passes have seen.
  double seen_ = 0;                  // How far the last pass of the march went [s].
  double end_ = 0, far_ = 0;
  std::stop_token stop_;
  std::int64_t step_limit_ = 0;
  std::int64_t passes_ = 0;
  bool aborted_ = false;
  Motion::Pause pause_ = Motion::Pause::kQuiet;
};

}  // namespace contact
