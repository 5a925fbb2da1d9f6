#pragma once

#include "cli/settings/command_line.h"

namespace contact::cli {

/// Adds the command `plot` to `model`: draws the coefficient α of damping laws, or the restitution
/// that they deliver, over the restitution asked for.
void AddLawPlot(CommandLine& line, CLI::App& model);

/// Adds the command `translate` to `model`: a contact in the parameters of other simulators, and
/// what they give back with them.
void AddTranslate(CommandLine& line, CLI::App& model);

}  // namespace contact::cli
