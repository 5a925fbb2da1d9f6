#pragma once

#include <string>
#include <vector>

#include "cli/settings/command_line.h"

namespace contact::cli {

/// The names of the figures that can be made of a run, such as `force`.
const std::vector<std::string>& PresetNames();

/// Adds the flags of `plot` that say what part of a run a figure shows, and how it looks.
void AddPlotOptions(CommandLine& line, CLI::App& command);

/// Those of them that the parsed line has, as words for contactsim.
std::vector<std::string> GivenPlotOptions(const CLI::App& command);

}  // namespace contact::cli
