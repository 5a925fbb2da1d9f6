#pragma once

#include "cli/settings/command_line.h"

namespace contact::cli {

/// Adds the command `translate` to `model`: a contact in the parameters of other simulators, and
/// what they give back with them.
void AddTranslate(CommandLine& line, CLI::App& model);

}  // namespace contact::cli
