#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cli/link/recording.h"
#include "wire/scenario/scenario_codec.h"

namespace contact::cli {

/// Energy [J] at each sample by what holds it: bodies, contacts, supports and loads that stay the
/// same, such as gravity, if any, and the sum, which damping and other loads change. That of loads
/// is 0 where positions are. Throws Failure (kUsage) without a recorded trajectory.
std::vector<std::pair<std::string, std::vector<double>>> MechanicalEnergy(
    const Scenario& scenario, const Recording& recording);

}  // namespace contact::cli
