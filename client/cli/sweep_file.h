#pragma once

#include <string>

#include "contact/v1/scenario.pb.h"

namespace contact::cli {

/// Reads a sweep file: the message Sweep in YAML, whose `base` may also be the name of a scenario
/// file, from the folder of the sweep file. Checks the rules of the contract. Throws Failure:
/// kInvalidScenario, which lists every mistake at its place, or kLocal.
v1::Sweep OpenSweep(const std::string& path);

}  // namespace contact::cli
