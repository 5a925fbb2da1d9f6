#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "simulation/episode/problem.h"
#include "simulation/episode/run_state.h"
#include "testing/cases.h"

namespace contact::testing {

/// Keeps also the states between episodes.
struct Traced final : Record {
  std::vector<State> starts;
  void OnBoundary(const std::function<RunState()>& state) override {
    starts.push_back(state().state);
  }
};

/// The episode of a group with the μ of the ledger, to be passed through with another μ of it.
class Replay {
 public:
  Replay(const Scenario& scenario, const Traced& run, const Group& group)
      : motion_(scenario), problem_(scenario, motion_, observer_) {
    start_ = InitialState(scenario);
    for (const State& state : run.starts) {
      if (state.time <= group.start_time) start_ = state;
    }
    problem_.Begin(start_, scenario.end_time, {}, scenario.solver.max_steps);
    for (int c = 0; c < std::ssize(scenario.contacts); ++c) Take(run, c, group);
  }

  /// ε_out² − ε_in² of the group with this μ; −1 if it does not end.
  double Excess(double mu) {
    problem_.groups.At(id_).mu = mu;
    const Sight sight = problem_.Evaluate({id_}, false, 1e300);
    const GroupSight* g = sight.Find(id_);
    if (g == nullptr || !g->ended) return -1;
    most = problem_.MostMu(*g);
    return g->squared - g->restitution_in * g->restitution_in;
  }

  double most = 0;  ///< The largest μ that the group could feel when it was seen last.

 private:
  // Cycles of a contact in order; each that is in no group was one of negligible work.
  void Take(const Traced& run, int contact, const Group& wanted) {
    GroupId id{.contact = contact};
    bool touches = true;
    for (const Group* last = nullptr; const Cycle& c : run.cycles) {
      if (c.contact != contact) continue;
      const Group* group = GroupOf(run, c);
      if (std::exchange(touches, c.end == Cycle::End::kSeparation)) id.place = 0, last = nullptr;
      if (c.turn_time == c.end_time) {  // It rested.
        problem_.groups.NoteRestEnd(id, c.end_time);
        continue;
      }
      if (group != nullptr) id.encounter = group->encounter;
      if (group == nullptr || group != last) ++id.place;
      last = group;
      if (group == nullptr && id.place == 1) continue;  // Its encounter has no name.
      Unknown& unknown = problem_.groups.At(id);
      unknown.mu = unknown.first_mu = c.mu;
      unknown.corrected = true;
      unknown.weak = group == nullptr;
      const bool first = group == nullptr || group->first_cycle == c.number;
      unknown.lasts = first ? 0 : c.turn_time - group->start_time;
      if (group == &wanted) id_ = id;
    }
  }

  static const Group* GroupOf(const Traced& run, const Cycle& cycle) {
    const auto found = std::ranges::find_if(run.groups, [&](const Group& g) {
      return g.contact == cycle.contact && g.number == cycle.group;
    });
    return found == run.groups.end() ? nullptr : &*found;
  }

  Observer observer_;
  State start_;
  Motion motion_;
  Problem problem_;
  GroupId id_;
};

/// Whether ε_out² goes through ε_in² between two μ, and does not jump: README.md, (N4).
inline bool HasRoot(Replay& replay, double more, double less) {
  double above = 1, below = -1;
  while (std::abs(more - less) > 1e-11 * less) {
    const double mu = (more + less) / 2;
    const double excess = replay.Excess(mu);
    (excess > 0 ? more : less) = mu;
    (excess > 0 ? above : below) = excess;
  }
  return above < 1e-4 && below > -1e-4;  // Of a jump both stay larger.
}

}  // namespace contact::testing
