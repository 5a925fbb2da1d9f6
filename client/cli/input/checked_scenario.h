#pragma once

#include <string>
#include <vector>

#include "cli/input/scenario_file.h"

namespace contact::cli {

/// Reads a scenario file with these values of its variables, applies the overrides and checks the
/// rules. Throws Failure (kInvalidScenario) that lists every mistake.
ScenarioFile OpenChecked(const std::string& path, const std::vector<std::string>& overrides,
                         const ScenarioLimits& limits = {}, const VariableValues& variables = {});

/// Throws Failure (kInvalidScenario) if the file has mistakes.
void RequireNoMistakes(const ScenarioFile& file);

/// Tells on the standard error what Check advises.
void TellAdvice(const ScenarioFile& file);

}  // namespace contact::cli
