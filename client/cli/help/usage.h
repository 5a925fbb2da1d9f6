#pragma once

#include <CLI/App.hpp>
#include <CLI/Error.hpp>
#include <string>

#include "cli/settings/settings.h"

namespace contact::cli {

/// What is wrong with a command line, in the words of CLI11, or better ones where a command, a flag
/// or a value is misspelt; and where to read more.
std::string UsageMessage(CLI::App& app, const CLI::ParseError& error);

/// Adds `help`, which shows the same as --help, or a tutorial.
void AddHelpCommand(CLI::App& app, Action* action);

}  // namespace contact::cli
