#pragma once

#include "cli/input/scenario_file.h"

namespace contact::cli {

/// Throws Failure (kInvalidScenario) if the file has mistakes.
void RequireNoMistakes(const ScenarioFile& file);

/// Tells on the standard error what Check advises.
void TellAdvice(const ScenarioFile& file);

}  // namespace contact::cli
