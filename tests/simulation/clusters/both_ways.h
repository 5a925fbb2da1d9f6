// Runs that are solved in clusters beside the same with all bodies together.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "testing/cases.h"

namespace contact::testing {

inline void ExpectClosedBalances(const Outcome& outcome) {
  EXPECT_EQ(outcome.end, Outcome::End::kFinished) << outcome.message;
  EXPECT_LT(outcome.energy_residual, 1e-9);
  EXPECT_LT(outcome.momentum_residual, 1e-9);
  EXPECT_LT(outcome.worst_identity_residual, 1e-8);
}

// Times within `time` [s], and μ within `mu`, relative. Rows that the end cuts have a μ by what
// comes after it, of which a part knows less.
inline void ExpectSame(const Record& parts, const Record& whole, double time, double mu) {
  const auto rows_of = [](const Record& record) {
    std::map<std::pair<int, int>, Cycle> rows;
    for (const Cycle& cycle : record.cycles) rows[{cycle.contact, cycle.number}] = cycle;
    return rows;
  };
  const auto all = rows_of(whole), rows = rows_of(parts);
  ASSERT_EQ(rows.size(), all.size());
  for (const auto& [name, a] : all) {
    const auto found = rows.find(name);
    ASSERT_NE(found, rows.end()) << name.first << " " << name.second;
    const Cycle& b = found->second;
    EXPECT_EQ(b.status, a.status) << name.first << " " << name.second;
    EXPECT_EQ(b.group, a.group);
    EXPECT_NEAR(b.start_time, a.start_time, time);
    EXPECT_NEAR(b.end_time, a.end_time, time);
    if (a.status == Cycle::Status::kConverged) {
      EXPECT_NEAR(b.mu / a.mu, 1, mu);
    }
  }
}

// How many runs have ended both ways, and of these with as many cycles.
struct Both {
  int finished = 0, same = 0;
};

// Of the scenarios that `make` makes of the seeds from 1 to `seeds`; each keeps its balances in
// clusters, that of the energy to `energy`, relative.
template <class Make>
Both RunBothWays(const Make& make, unsigned seeds, double energy) {
  Both both;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const Scenario s = make(seed);
    const Record parts = RunAndRecord(s), whole = RunTogether(s);
    EXPECT_NE(parts.outcome.end, Outcome::End::kNumeric) << seed << parts.outcome.message;
    if (parts.outcome.end != Outcome::End::kFinished) continue;
    EXPECT_LT(parts.outcome.energy_residual, energy) << seed;
    EXPECT_LT(parts.outcome.momentum_residual, 1e-9) << seed;
    if (whole.outcome.end != Outcome::End::kFinished) continue;
    EXPECT_GE(parts.outcome.all_converged, whole.outcome.all_converged) << seed;
    ++both.finished;
    both.same += parts.cycles.size() == whole.cycles.size();
  }
  return both;
}

}  // namespace contact::testing
