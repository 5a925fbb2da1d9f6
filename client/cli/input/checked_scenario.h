#pragma once

#include <string>
#include <vector>

#include "cli/input/scenario_file.h"

namespace contact::cli {

/// The scenario with the overrides, such as `end_time_s=1e-3`, and its rules checked. Throws
/// Failure (kInvalidScenario) that lists every mistake.
ScenarioFile Checked(ScenarioFile file, const std::vector<std::string>& overrides,
                     const ScenarioLimits& limits = {});

/// Tells on the standard error what Check advises.
void TellAdvice(const ScenarioFile& file);

}  // namespace contact::cli
