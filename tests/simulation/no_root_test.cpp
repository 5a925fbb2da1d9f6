// Where the search says that no μ gives the restitution asked for, a scan over μ finds none.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "simulation/episode/problem.h"
#include "simulation/kinds.h"
#include "testing/cases.h"

namespace contact {
namespace {

using testing::Record;

// A run's groups with the μ of its ledger, to be passed through with another μ of one of them.
class Replay {
 public:
  Replay(const Scenario& scenario, const Record& run)
      : start_(InitialState(scenario)),
        motion_(scenario),
        problem_(scenario, motion_, observer_) {
    problem_.Begin(start_, scenario.end_time, {}, scenario.solver.max_steps);
    for (int c = 0; c < std::ssize(scenario.contacts); ++c) Take(run, c);
  }

  /// ε_out² − ε_in² of the group with this μ; −1 if it does not end.
  double Excess(const GroupId& id, double mu) {
    Unknown& unknown = problem_.groups.At(id);
    const double kept = std::exchange(unknown.mu, mu);
    const Sight sight = problem_.Evaluate({id}, false, 1e300);
    unknown.mu = kept;
    const GroupSight* g = sight.Find(id);
    if (g == nullptr || !g->ended) return -1;
    return g->squared - g->restitution_in * g->restitution_in;
  }

  /// The name in the search of a group of the ledger.
  GroupId IdOf(const Group& group) const { return ids_.at({group.contact, group.number}); }

 private:
  // Cycles of a contact in order; each that is in no group was one of negligible work.
  void Take(const Record& run, int contact) {
    GroupId id{.contact = contact, .encounter = 0, .place = 0};
    int last = -1;
    for (const Cycle& c : run.cycles) {
      if (c.contact != contact) continue;
      if (c.start_deformation == 0) ++id.encounter, id.place = 0, last = -1;
      if (c.group == 0 || c.group != last) ++id.place;
      Unknown& unknown = problem_.groups.At(id);
      if (c.group == 0 || c.group != last) begin_ = c.start_time;
      unknown.mu = unknown.first_mu = c.mu;
      unknown.corrected = true;
      unknown.weak = c.group == 0;
      unknown.lasts = c.group != 0 && c.group == last ? c.turn_time - begin_ : 0;
      if (c.group != 0) ids_[{contact, c.group}] = id;
      last = c.group;
    }
  }

  Observer observer_;
  State start_;
  Motion motion_;
  Problem problem_;
  double begin_ = 0;  // Of the last group taken [s].
  std::map<std::pair<int, int>, GroupId> ids_;
};

// Whether ε_out² − ε_in² is 0 between two μ where it has different signs: its halvings tend to 0.
bool HasRoot(Replay& replay, const GroupId& id, double more, double less) {
  double above = 0, below = 0;
  for (int i = 0; i < 50; ++i) {
    const double mu = (more + less) / 2;
    const double excess = replay.Excess(id, mu);
    (excess > 0 ? more : less) = mu;
    (excess > 0 ? above : below) = excess;
    if (std::abs(more - less) < 1e-12 * less) break;
  }
  return std::min(above, -below) < 1e-6;
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

void ExpectNoRoot(const Scenario& scenario, const Record& run, Cycle::Status status) {
  Replay replay(scenario, run);
  int found = 0;
  for (const Group& g : run.groups) {
    if (g.status != status || g.end == Cycle::End::kRunEnd) continue;
    ++found;
    const GroupId id = replay.IdOf(g);
    const double square = g.restitution_out * g.restitution_out;
    EXPECT_NEAR(replay.Excess(id, g.mu) + g.restitution_in * g.restitution_in, square,
                1e-6 * square + 1e-9);
    const double stiffness = scenario.contacts[static_cast<std::size_t>(g.contact)].stiffness;
    double before = kNaN, last = 0;
    for (const double mu : Grid(g.mu, stiffness)) {
      const double excess = replay.Excess(id, mu);
      EXPECT_GT(std::abs(excess), 1e-6) << mu;
      if (before * excess < 0) {
        EXPECT_FALSE(before > 0 ? HasRoot(replay, id, last, mu) : HasRoot(replay, id, mu, last))
            << "group " << g.number << " of contact " << g.contact << " near μ = " << mu;
      }
      before = excess, last = mu;
    }
  }
  EXPECT_GT(found, 0);
}

TEST(NoRoot, OfAGroupThatJumps) {
  const Scenario scenario = testing::Dice(9, testing::Kind::kPressed).Roll();
  ExpectNoRoot(scenario, testing::RunAndRecord(scenario), Cycle::Status::kJump);
}

class Alone : public ::testing::TestWithParam<unsigned> {};

TEST_P(Alone, NoInfeasibleCycleHasARoot) {
  Scenario scenario = testing::Dice(GetParam(), testing::Kind::kWall).Roll();
  scenario.solver.restitution_scope = RestitutionScope::kCycle;
  ExpectNoRoot(scenario, testing::RunAndRecord(scenario), Cycle::Status::kInfeasible);
}

INSTANTIATE_TEST_SUITE_P(NoRoot, Alone, ::testing::Values(1, 2, 3, 4, 5, 6, 7, 8));

}  // namespace
}  // namespace contact
