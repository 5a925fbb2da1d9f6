#pragma once

#include <CLI/CLI.hpp>  // All of it: App.hpp alone leaves vtables to others.

#include "cli/settings/settings.h"

namespace contact::cli {

/// Each adds its commands to the command line; the one that is chosen sets `action`.

void AddRunCommands(CLI::App& app, const Settings& settings, Action* action);       // run, submit
void AddWatchCommands(CLI::App& app, const Settings& settings, Action* action);     // watch, wait
void AddJobCommands(CLI::App& app, const Settings& settings, Action* action);       // list, …
void AddArtifactCommands(CLI::App& app, const Settings& settings, Action* action);  // artifact …
void AddExportCommand(CLI::App& app, const Settings& settings, Action* action);     // export
void AddPlotCommand(CLI::App& app, const Settings& settings, Action* action);       // plot
void AddCompareCommand(CLI::App& app, const Settings& settings, Action* action);    // compare
void AddReportCommand(CLI::App& app, const Settings& settings, Action* action);     // report
void AddScenarioCommands(CLI::App& app, const Settings& settings,
                         Action* action);                                         // validate, init
void AddSeriesCommands(CLI::App& app, const Settings& settings, Action* action);  // series
void AddSweepCommands(CLI::App& app, const Settings& settings, Action* action);   // sweep run, …
void AddSweepCellCommands(CLI::App& sweep, const Settings& settings,
                          Action* action);                                        // heatmap, cell
void AddServerCommands(CLI::App& app, const Settings& settings, Action* action);  // version, server
void AddModelCommands(CLI::App& app, const Settings& settings, Action* action);   // model

void AddSchemaCommand(CLI::App& app, const Settings& settings, Action* action);   // schema
void AddConfigCommands(CLI::App& app, const Settings& settings, Action* action);  // config
void AddCompletionCommand(CLI::App& app, Action* action);                         // completion
void AddDevCommand(CLI::App& app, const Settings& settings, Action* action);      // dev
void AddDoctorCommand(CLI::App& app, const Settings& settings, Action* action);   // doctor
void AddPaperCommand(CLI::App& app, const Settings& settings, Action* action);    // paper

}  // namespace contact::cli
