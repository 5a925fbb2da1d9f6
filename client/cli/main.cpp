#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <system_error>

#include "cli/commands.h"
#include "wire/spelling.h"

namespace contact::cli {
namespace {

constexpr char kTour[] =
    R"(Simulates contacts whose restitution is what you asked for, on a contactd server.

Start here:
  contactd --listen 127.0.0.1:7070 --data-dir data &   a server
  contactctl init three-ball-chain                     an example scenario
  contactctl run three-ball-chain.yaml                 submit it, watch it, see its ledger
  contactctl run three-ball-chain.yaml --set contacts[0].restitution=0.7 -o json
  contactctl list                                      what the server has)";

constexpr char kCodes[] =
    R"(Exit codes: 0 ok, 1 run failed, 2 usage, 3 invalid scenario, 4 unreachable, 5 timeout,
6 not found, 7 not converged, 8 differs, 9 not allowed, 10 overload, 11 local file, 130 interrupted.)";

void AddGlobalFlags(CLI::App& app, Settings* settings) {
  app.add_option("--server", settings->server, "The server")
      ->envname("CONTACT_SERVER")
      ->type_name("HOST:PORT")
      ->capture_default_str();
  app.add_option(
         "-o,--output", settings->output,
         "How to print: table, json, name; jsonl (watch, export); csv (series, sweep, model, "
         "export); netcdf (export); svg, png, pdf, gp, csv (plot)")
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
  AddGlobalFlags(app, &settings);
  AddRunCommands(app, settings, &action);
  AddWatchCommands(app, settings, &action);
  AddJobCommands(app, settings, &action);
  AddExportCommand(app, settings, &action);
  AddPlotCommand(app, settings, &action);
  AddCompareCommand(app, settings, &action);
  AddReportCommand(app, settings, &action);
  AddScenarioCommands(app, settings, &action);
  AddSeriesCommands(app, settings, &action);
  AddSweepCommands(app, settings, &action);
  AddServerCommands(app, settings, &action);
  AddPaperCommand(app, settings, &action);
  AddModelCommands(app, settings, &action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    throw Failure(ExitCode::kUsage, UsageMessage(app, error) + "\nSee contactctl --help.");
  }
  if (!action) {
    fmt::print("{}", app.help());
    return 0;
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
