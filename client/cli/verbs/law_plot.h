#pragma once

#include <CLI/App.hpp>

#include "cli/settings/settings.h"

namespace contact::cli {

/// Adds `plot` to the command `model`: α, or the restitution delivered, over the one asked for.
void AddLawPlotCommand(CLI::App& model, const Settings& settings, Action* action);

}  // namespace contact::cli
