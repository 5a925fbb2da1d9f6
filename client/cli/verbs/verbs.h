#pragma once

#include <CLI/CLI.hpp>  // All of it: App.hpp alone leaves vtables to others.
#include <string_view>
#include <vector>

#include "cli/settings/command_line.h"

namespace contact::cli {

/// A command of contactctl.
struct Verb {
  std::string_view name;   ///< What is typed.
  std::string_view about;  ///< Its line in the help; begins with a verb.
  /// Adds arguments and action, or commands below it, to the new and empty `command`.
  void (*add)(CommandLine& line, CLI::App& command);
  /// False: it works although a config file or an environment variable is wrong, so that the user
  /// can find out.
  bool needs_settings = true;
};

/// All verbs, in the order of the help.
const std::vector<Verb>& Verbs();

/// Adds all verbs to the command line.
void AddVerbs(CommandLine& line);

/// True if the parsed line names a verb that needs valid settings.
bool NeedsSettings(const CLI::App& app);

/// The `add` functions of the verbs; AddX is in command_x.cpp, or beside a verb that is alike.
void AddArtifact(CommandLine& line, CLI::App& command);
void AddCancel(CommandLine& line, CLI::App& command);
void AddCompare(CommandLine& line, CLI::App& command);
void AddCompletion(CommandLine& line, CLI::App& command);
void AddConfig(CommandLine& line, CLI::App& command);
void AddDelete(CommandLine& line, CLI::App& command);
void AddDescribe(CommandLine& line, CLI::App& command);
void AddDev(CommandLine& line, CLI::App& command);
void AddDoctor(CommandLine& line, CLI::App& command);
void AddExport(CommandLine& line, CLI::App& command);
void AddHelp(CommandLine& line, CLI::App& command);
void AddInit(CommandLine& line, CLI::App& command);
void AddList(CommandLine& line, CLI::App& command);
void AddModel(CommandLine& line, CLI::App& command);
void AddPaper(CommandLine& line, CLI::App& command);
void AddPlot(CommandLine& line, CLI::App& command);
void AddReport(CommandLine& line, CLI::App& command);
void AddRun(CommandLine& line, CLI::App& command);
void AddSchema(CommandLine& line, CLI::App& command);
void AddSeries(CommandLine& line, CLI::App& command);
void AddServer(CommandLine& line, CLI::App& command);
void AddSubmit(CommandLine& line, CLI::App& command);
void AddSweep(CommandLine& line, CLI::App& command);
void AddValidate(CommandLine& line, CLI::App& command);
void AddVersion(CommandLine& line, CLI::App& command);
void AddWait(CommandLine& line, CLI::App& command);
void AddWatch(CommandLine& line, CLI::App& command);

/// Adds `heatmap` and `cell` to `sweep`.
void AddSweepCell(CommandLine& line, CLI::App& sweep);

}  // namespace contact::cli
