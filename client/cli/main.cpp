#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <system_error>

#include "cli/commands.h"
#include "cli/completion.h"
#include "cli/manual.h"
#include "cli/resolve.h"
#include "wire/spelling.h"

namespace contact::cli {
namespace {

constexpr char kTour[] =
    R"(Simulates contacts whose restitution is what you asked for, on a contactd server.
A scenario is a YAML file: bodies on a line, their contacts, what holds and drives them.
A job is a scenario that the server solves, and it goes on when you leave.
Its result is a ledger of every contact cycle, the recorded motion, and figures.
No server yet?  contactctl dev starts one. Something wrong?  contactctl doctor looks.
All commands:   contactctl --help, and for one of them contactctl run --help.

  contactctl init three-ball-chain        write an example scenario
  contactctl run three-ball-chain.yaml    submit it, watch it, see its ledger
  contactctl plot JOB hysteresis          draw the force over the deformation)";

constexpr char kCodes[] =
    R"(Exit codes: 0 ok, 1 run failed, 2 usage, 3 invalid scenario, 4 unreachable, 5 timeout,
6 not found, 7 not converged, 8 differs from the paper, 9 not allowed, 10 overload, 11 local file, 130 interrupted.)";

void AddGlobalFlags(CLI::App& app, Settings* settings) {
  app.add_option("--server", settings->server, "The server")
      ->type_name("HOST:PORT")
      ->capture_default_str();
  app.add_option("-o,--output", settings->output,
                 "How to print: table, json, name; jsonl (watch, list --watch, export); csv "
                 "(series, sweep, model, export); netcdf (export); svg, png, pdf, gp, csv (plot)")
      ->check(CLI::IsMember(
          {"table", "json", "jsonl", "name", "csv", "netcdf", "svg", "png", "pdf", "gp"}))
      ->type_name("FORMAT")
      ->capture_default_str();
  app.add_option("--color", settings->color, "auto, always or never; NO_COLOR is heeded")
      ->check(CLI::IsMember({"auto", "always", "never"}))
      ->type_name("WHEN")
      ->capture_default_str();
  app.add_option("--timeout", settings->timeout,
                 "Give up after this time. Default: 10s for a call, none for run, watch and wait")
      ->type_name("TIME");
  app.add_option("--profile", settings->profile, "Use the values of this section of config files")
      ->type_name("PROFILE");
}

// A config file that is wrong must not keep its owner from finding out.
bool NeedsSettings(const CLI::App& app) {
  const std::string& command = app.get_subcommands().front()->get_name();
  return command != "config" && command != "version" && command != "schema" &&
         command != "completion" && command != "doctor";
}

void AddCommands(CLI::App& app, const Settings& settings, Action* action) {
  AddRunCommands(app, settings, action);
  AddWatchCommands(app, settings, action);
  AddJobCommands(app, settings, action);
  AddArtifactCommands(app, settings, action);
  AddExportCommand(app, settings, action);
  AddPlotCommand(app, settings, action);
  AddScenarioCommands(app, settings, action);
  AddSchemaCommand(app, settings, action);
  AddSeriesCommands(app, settings, action);
  AddSweepCommands(app, settings, action);
  AddServerCommands(app, settings, action);
  AddPaperCommand(app, settings, action);
  AddModelCommands(app, settings, action);
  AddConfigCommands(app, settings, action);
  AddCompletionCommand(app, action);
  AddDevCommand(app, settings, action);
  AddDoctorCommand(app, settings, action);
}

std::vector<std::string_view> Known(const CLI::App& app, bool flags,
                                    std::vector<std::string>* storage) {
  for (const CLI::App* scope = &app; scope != nullptr; scope = scope->get_parent()) {
    for (const CLI::Option* option : scope->get_options()) {
      for (const std::string& name : option->get_lnames()) {
        if (flags) storage->push_back("--" + name);
      }
    }
  }
  for (const CLI::App* command : app.get_subcommands({})) {
    if (!flags) storage->push_back(command->get_name());
  }
  return {storage->begin(), storage->end()};
}

// The words of CLI11, or better ones where a command or flag is misspelt.
std::string UsageMessage(CLI::App& app, const CLI::ParseError& error) {
  CLI::App* scope = &app;
  while (!scope->get_subcommands().empty()) scope = scope->get_subcommands().front();
  std::vector<std::string> extras = app.remaining(true);
  const bool group = !scope->get_subcommands({}).empty();
  if (extras.empty() || (scope != &app && !group && !extras.front().starts_with("-"))) {
    return error.what();
  }
  const std::string& extra = extras.front();
  const bool flag = extra.starts_with("-");
  std::vector<std::string> storage;
  const std::string_view nearest =
      Nearest(extra.substr(0, extra.find('=')), Known(*scope, flag, &storage));
  return fmt::format("unknown {} {}{}", flag ? "flag" : "command", Quoted(extra),
                     nearest.empty() ? "" : fmt::format(" — did you mean '{}'?", nearest));
}

int Tell(const Failure& failure) {
  const bool list = failure.code() == ExitCode::kInvalidScenario;
  fmt::print(stderr, "{}{}\n", list ? "" : "contactctl: ", failure.what());
  return static_cast<int>(failure.code());
}

int Main(int argc, char** argv) {
  Settings settings;
  Action action;
  CLI::App app(kTour, "contactctl");
  app.footer(kCodes);
  app.fallthrough();
  app.require_subcommand(0, 1);  // So `schema sweep` is an argument, not the command sweep.
  AddGlobalFlags(app, &settings);
  AddCommands(app, settings, &action);
  if (argc > 1 && std::string_view(argv[1]) == "__complete") {
    fmt::print("{}", Complete(app, {argv + 2, argv + argc}, &settings));
    return 0;
  }
  if (argc == 4 && std::string_view(argv[1]) == "__man") {
    WriteManual(app, argv[2], argv[3]);
    return 0;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    throw Failure(ExitCode::kUsage, UsageMessage(app, error) + "\nSee contactctl --help.");
  }
  if (!action) {
    fmt::print("{}\n", kTour);
    return 0;
  }
  ResolveSettings(app, &settings);
  if (!settings.problems.empty() && NeedsSettings(app)) {
    throw Failure(settings.problems.front().code, settings.problems.front().text);
  }
  const ExitCode code = action();
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    throw Failure(ExitCode::kLocal, "cannot write to the standard output");
  }
  return static_cast<int>(code);
}

}  // namespace
}  // namespace contact::cli

int main(int argc, char** argv) {
  try {
    return contact::cli::Main(argc, argv);
  } catch (const contact::cli::Failure& failure) {
    return contact::cli::Tell(failure);
  } catch (const std::system_error& error) {  // fmt could not write to a stream.
    fmt::print(stderr, "contactctl: {}\n", error.what());
    return static_cast<int>(contact::cli::ExitCode::kLocal);
  } catch (const std::exception& error) {
    fmt::print(stderr, "contactctl: {}\n", error.what());
    return static_cast<int>(contact::cli::ExitCode::kRunFailed);
  }
}
