// Where the search says that no μ gives the restitution asked for, a scan over μ finds none.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "simulation/episode/problem.h"
#include "simulation/episode/run_state.h"
#include "simulation/kinds.h"
#include "testing/cases.h"

namespace contact {
namespace {

using testing::Record;

// Keeps also the states between episodes.
struct Traced final : Record {
  std::vector<State> starts;
  void OnBoundary(const std::function<RunState()>& state) override {
    starts.push_back(state().state);
  }
};

// The episode of a group with the μ of the ledger, to be passed through with another μ of it.
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

// Whether ε_out² goes through ε_in² between two μ, and does not jump: README.md, (N4).
bool HasRoot(Replay& replay, double more, double less) {
  double above = 1, below = -1;
  while (std::abs(more - less) > 1e-11 * less) {
    const double mu = (more + less) / 2;
    const double excess = replay.Excess(mu);
    (excess > 0 ? more : less) = mu;
    (excess > 0 ? above : below) = excess;
  }
  return above < 1e-4 && below > -1e-4;  // Of a jump both stay larger.
}

// μ from 0 to thousands of times what an isolated collision would have, and densely near that of
// the ledger.
std::vector<double> Grid(double mu, double stiffness) {
  std::vector<double> grid = {0};
  for (int i = -60; i <= 60; ++i) grid.push_back(stiffness * std::pow(10, 0.1 * i));
  for (int i = -100; i <= 100; ++i) grid.push_back(mu * (1 + 1e-3 * i));
  std::ranges::sort(grid);
  return grid;
}

// Looks at all groups of a run without a solution. Returns how many there are.
int ExpectNoRoot(const Scenario& scenario) {
  Traced run;
  run.outcome = Run(scenario, run);
  int found = 0;
  for (const Group& g : run.groups) {
    if (g.status != Cycle::Status::kInfeasible || g.end == Cycle::End::kRunEnd) continue;
    if (std::isnan(g.restitution_out)) continue;
    ++found;
    Replay replay(scenario, run, g);
    const double square = g.restitution_out * g.restitution_out, kept = replay.Excess(g.mu);
    // Where a larger μ does not end, the one next to it may take more steps than a pass has.
    const bool creeps = kept == -1 && g.too_little.restitution == 0;
    if (!creeps) {  // W_c is known to 1e-9 of W_r, where it is nearly nothing.
      const double known = 1e-6 * square + 1e-9 * (1 + square * square);
      EXPECT_NEAR(kept + g.restitution_in * g.restitution_in, square, known);
    }
    const double stiffness = scenario.contacts[static_cast<std::size_t>(g.contact)].stiffness;
    double before = kNaN, last = 0;
    for (const double mu : Grid(g.mu, stiffness)) {
      const double excess = replay.Excess(mu);
      if (mu > replay.most) break;
      EXPECT_GT(std::abs(excess), 1e-6) << mu;
      if (before * excess < 0) {
        EXPECT_FALSE(before > 0 ? HasRoot(replay, last, mu) : HasRoot(replay, mu, last))
            << "group " << g.number << " of contact " << g.contact << " near μ = " << mu;
      }
      before = excess, last = mu;
    }
  }
  return found;
}

using testing::Kind;

// Seeds from `first` on, before `end`. `exchanged`: the body that is held is shaken, and the other
// way round.
struct Sample {
  Kind kind;
  unsigned first, end;
  bool exchanged = false;
};

Scenario RollOf(const Sample& sample, unsigned seed) {
  Scenario scenario = testing::Dice(seed, sample.kind).Roll();
  scenario.solver.restitution_scope = RestitutionScope::kCycle;
  if (!sample.exchanged) return scenario;
  Support& support = scenario.supports.front();
  std::swap(support.body, scenario.loads.front().body);
  support.rest_position = scenario.bodies[static_cast<std::size_t>(support.body)].position;
  return scenario;
}

class Alone : public ::testing::TestWithParam<Sample> {};

TEST_P(Alone, NoInfeasibleCycleHasARoot) {
  int found = 0;
  for (unsigned seed = GetParam().first; seed < GetParam().end; ++seed) {
    SCOPED_TRACE(seed);
    found += ExpectNoRoot(RollOf(GetParam(), seed));
  }
  EXPECT_GT(found, 0);
}

INSTANTIATE_TEST_SUITE_P(NoRoot, Alone,
                         ::testing::Values(Sample{Kind::kRow, 11, 21}, Sample{Kind::kGaps, 6, 11},
                                           Sample{Kind::kWall, 12, 15},
                                           Sample{Kind::kSupport, 12, 14},
                                           Sample{Kind::kSupport, testing::kOptimized ? 0U : 11U,
                                                  testing::kOptimized ? 24U : 12U, true},
                                           Sample{Kind::kPressed, 0, 4}),
                         [](const auto& made) {
                           const auto kind = static_cast<int>(made.param.kind);
                           return std::string(testing::kKindNames[kind]) +
                                  (made.param.exchanged ? "_exchanged" : "");
                         });

}  // namespace
}  // namespace contact
