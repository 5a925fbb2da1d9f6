#pragma once

#include <CLI/CLI.hpp>  // All of it: App.hpp alone lacks definitions.
#include <string_view>
#include <vector>

#include "cli/settings/command_line.h"

namespace contact::cli {

/// Adds arguments and action of a verb, or commands below it, to the new and empty `command`.
using AddVerb = void(CommandLine& line, CLI::App& command);

/// A command of contactctl.
struct Verb {
  /// What is typed.
  std::string_view name;
  /// Its line in the help; begins with a verb.
  std::string_view about;
  /// Adds it to the command line.
  AddVerb* add;
  /// False: it works although a config file or an environment variable is wrong, so that the user
  /// can find out.
  bool needs_settings;
};

/// All verbs, in the order of the help.
const std::vector<Verb>& Verbs();

/// Adds all verbs to the command line.
void AddVerbs(CommandLine& line);

/// True if the parsed line names a verb that needs valid settings.
bool NeedsSettings(const CLI::App& app);

/// The `add` functions of the verbs of verbs.def.
#define VERB(function, name, needs_settings, about) AddVerb function;
#include "cli/verbs/verbs.def"
#undef VERB

/// Adds `heatmap` and `cell` to `sweep`.
void AddSweepCell(CommandLine& line, CLI::App& sweep);

}  // namespace contact::cli
