#pragma once

#include <string>

#include "simulation/proof/restate.h"
#include "testing/cases.h"

namespace contact::testing {

/// The largest relative difference between two answers, and where it is.
struct Difference {
  double worst = 0;
  std::string where;
  void Take(double value, const std::string& at);  ///< Keeps the larger one; NaN is largest.
};

/// How far the answers of a run in other words are from those of the first: velocities at the end
/// over the largest speed, and μ and peak force of every CONVERGED group that the end of the first
/// run does not cut. A group that has no counterpart at its time counts as 1.
Difference Compare(const Scenario& scenario, const Record& run, const Restated& other,
                   const Record& again);

/// Of all ways to say the scenario: runs them, and compares with `run`, which has finished.
Difference CompareWithOtherWords(const Scenario& scenario, const Record& run);

}  // namespace contact::testing
