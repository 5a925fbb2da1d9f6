#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/input/scenario_file.h"
#include "contact/v1/scenario.pb.h"

namespace contact::cli {

/// Cells with values drawn at random, instead of every combination of the values.
struct DrawnCells {
  /// How many cells are drawn; 0: the cells are all combinations of the values.
  int count = 0;
  /// True to cover every axis evenly; false to draw each value independently.
  bool latin_hypercube = false;
  /// Seed of the random numbers: the same seed gives the same cells.
  std::int64_t seed = 0;
};

/// The sweep of a scenario over some fields. Each axis is `FIELD=FIRST:LAST:COUNT`, in equal
/// steps, or `FIELD=A,B,C`, where FIELD is a path, or `var:NAME` for the fields whose value is the
/// variable of this name, and the cells are all combinations; or, if `drawn.count` is not 0, each
/// is `FIELD=LOW:HIGH` or `FIELD=A,B,C`, and the cells are drawn from them. Without `metrics` it
/// is `iterations`. Prints advice on the standard error. Throws Failure: kUsage for an axis of
/// another form or an unknown variable, kInvalidScenario with all mistakes.
v1::Sweep MakeGrid(const ScenarioFile& base, const std::vector<std::string>& axes,
                   const std::vector<std::string>& metrics, const DrawnCells& drawn = {});

}  // namespace contact::cli
