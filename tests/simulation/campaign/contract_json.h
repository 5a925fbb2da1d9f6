#pragma once

#include <string>

#include "simulation/model/scenario.h"

namespace contact::campaign {

/// A scenario as a line of JSON in the contract's fields, for contactctl.
std::string ContractJson(const Scenario& scenario, const std::string& title);

}  // namespace contact::campaign
