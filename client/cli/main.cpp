#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <system_error>

#include "cli/help/completion.h"
#include "cli/help/manual.h"
#include "cli/help/usage.h"
#include "cli/settings/resolve.h"
#include "cli/verbs/commands.h"

namespace contact::cli {
namespace {

constexpr char kTour[] =
    R"(Simulates contacts whose restitution is what you asked for, on a contactd server.
A scenario is a YAML file: bodies on a line, their contacts, what holds and drives them.
A job is a scenario that the server solves, and it goes on when you leave.
Its result is a ledger of every contact cycle, the recorded motion, and figures.
No server yet?  contactctl dev starts one. Something wrong?  contactctl doctor looks.
All commands:   contactctl --help; the way through them: contactctl help tutorial.

  contactctl init three-ball-chain        write an example scenario
  contactctl run three-ball-chain.yaml    submit it, watch it, see its ledger
  contactctl plot JOB hysteresis          draw the force over the deformation)";

constexpr char kCodes[] =
    R"(Exit codes: 0 ok, 1 run failed, 2 usage, 3 invalid scenario, 4 unreachable, 5 timeout,
6 not found, 7 not converged, 8 differs, 9 not allowed, 10 overload, 11 local file, 130 interrupted.)";

void AddGlobalFlags(CLI::App& app, Settings* settings) {
  app.add_option("--server", settings->server, "The server")
      ->type_name("HOST:PORT")
      ->capture_default_str();
  app.add_option_function<std::string>(
         "-o,--output", [settings](const std::string& name) { settings->SetOutput(name); },
         fmt::format("How to print: {}. export writes {}; plot draws {}", FormatHelp(kPrinted),
                     FormatHelp(kData), FormatHelp(kPicture)))
      ->check(CLI::IsMember(FormatNames(kPrinted | kData | kPicture)))
      ->type_name("FORMAT")
      ->default_str(std::string(NameOf(OutputFormat::kTable)));
  app.add_option("--color", settings->color, "auto, always or never; NO_COLOR is heeded")
      ->check(CLI::IsMember({"auto", "always", "never"}))
      ->type_name("WHEN")
      ->capture_default_str();
  app.add_option("--progress", settings->progress,
                 "How to tell how far a job is: bar, plain (a line for each tenth), json (an "
                 "object a line, "
                 "for programs) or none; auto is a bar on a terminal")
      ->check(CLI::IsMember({"auto", "bar", "plain", "json", "none"}))
      ->type_name("HOW")
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
         command != "completion" && command != "doctor" && command != "help";
}

void AddCommands(CLI::App& app, const Settings& settings, Action* action) {
  AddRunCommands(app, settings, action);
  AddWatchCommands(app, settings, action);
  AddJobCommands(app, settings, action);
  AddArtifactCommands(app, settings, action);
  AddExportCommand(app, settings, action);
  AddPlotCommand(app, settings, action);
  AddCompareCommand(app, settings, action);
  AddReportCommand(app, settings, action);
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
  AddHelpCommand(app, action);
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
    throw Failure(ExitCode::kUsage, UsageMessage(app, error));
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
