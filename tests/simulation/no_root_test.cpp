// Where the search says that no μ gives the restitution asked for, a scan over μ finds none.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "simulation/kinds.h"
#include "simulation/replay.h"

namespace contact {
namespace {

using testing::Replay;
using testing::Traced;

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
