#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/input/variables.h"
#include "contact/v1/scenario.pb.h"

namespace contact::cli {

/// Reads a sweep file: the message Sweep in YAML, whose `base` may also be the name of a scenario
/// file, from the folder of the sweep file. Checks the rules of the contract. Throws Failure:
/// kInvalidScenario, which lists every mistake at its place, or kLocal.
///
/// Of `variables` the file takes those that it has, its base the others. Throws Failure (kUsage)
/// if it has not one of these.
v1::Sweep OpenSweep(const std::string& path, const VariableValues& variables = {});

/// The same of text that stands in the file at `path`.
v1::Sweep ReadSweep(const std::string& path, const std::string& text,
                    const VariableValues& variables = {});

/// Cells with values drawn by chance, instead of every combination of the values.
struct DrawnCells {
  int count = 0;                 ///< 0: none are drawn.
  bool latin_hypercube = false;  ///< Every axis is covered evenly.
  std::int64_t seed = 0;         ///< The same seed, the same cells.
};

/// The sweep of a scenario file over some fields: every combination of their values, each axis as
/// `FIELD=FIRST:LAST:COUNT`, in equal steps, or `FIELD=A,B,C`; or cells drawn from axes of
/// `FIELD=LOW:HIGH` or `FIELD=A,B,C`. `metric` is `iterations` if empty. Throws as OpenSweep does,
/// and Failure (kUsage) for an axis that is none.
v1::Sweep MakeGrid(const std::string& scenario, const std::vector<std::string>& axes,
                   const std::string& metric, const DrawnCells& drawn = {},
                   const VariableValues& variables = {});

/// True if a document has a part that only a sweep has: `base` or `axes`.
bool IsSweep(const std::string& text);

}  // namespace contact::cli
