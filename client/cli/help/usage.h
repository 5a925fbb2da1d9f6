#pragma once

#include <CLI/Error.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "cli/settings/command_line.h"

namespace contact::cli {

/// What is wrong with a command line, and where to read more. An unknown command or flag comes with
/// the nearest one; all else is in the words of the parser.
std::string UsageMessage(const CLI::App& app, const CLI::ParseError& error);

/// The help of the command with these names, such as `sweep run`; of the program if there are none.
/// Throws Failure (kUsage) if there is no such command.
std::string HelpOf(CLI::App& app, const std::vector<std::string>& names);

/// A help text for a terminal of `width` characters (0: no limit): lines that are longer are broken
/// between words or behind commas, and what a name means stays in its column. On less than 60 it
/// stands below the name.
std::string WrapHelp(std::string_view text, int width);

/// Prints a help text as WrapHelp breaks it for the standard output.
void PrintHelp(std::string_view text);

}  // namespace contact::cli
