#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <system_error>

#include "cli/base/message.h"
#include "cli/base/number.h"
#include "cli/base/table.h"
#include "cli/base/text_file.h"
#include "cli/input/checked_scenario.h"
#include "cli/input/sweep_file.h"
#include "cli/input/templates.h"
#include "cli/link/connect.h"
#include "cli/text/render_estimate.h"
#include "cli/verbs/job/options.h"
#include "cli/verbs/verbs.h"
#include "wire/scenario/contact_codec.h"
#include "wire/sweep/sweep_codec.h"

namespace contact::cli {
namespace {

struct ValidateArguments {
  std::string file;
  std::vector<std::string> overrides;
  std::vector<std::string> variables;  // --var
  bool on_server = false;
};

struct InitArguments {
  std::string name;
  std::string file;
  bool list = false;
  bool force = false;
};

// Asks the server, whose limits may be narrower than those that are checked here. Its advice is
// not shown, because the check here has shown the same.
void ValidateOnServer(const v1::Job& job, const Settings& settings) {
  v1::CreateJobRequest request;
  *request.mutable_job() = job;
  request.set_validate_only(true);
  Client client = Connect(settings);
  const v1::Job checked = client.CallTellingAll(&Client::Stub::CreateJob, request);
  const v1::ServerInfo info = client.Call(&Client::Stub::GetServerInfo, v1::GetServerInfoRequest());
  fmt::print("contactd at {} would take it\n{}", client.server(),
             RenderEstimate(checked, info.limits(), settings.OutputStyle()));
}

// Checks a sweep and prints what it has. Returns a job with it.
v1::Job ValidateSweep(const ValidateArguments& arguments, const std::string& text) {
  if (!arguments.overrides.empty()) {
    throw Failure(ExitCode::kUsage, "--set is for scenarios; a sweep has axes");
  }
  const v1::Sweep sweep = ReadSweep(arguments.file, text, ParseVariables(arguments.variables));
  fmt::print(
      "{}: valid; {}, {}, {}\n", arguments.file,
      Count(
          DecodeSweep(sweep, {.max_cells = std::numeric_limits<std::int32_t>::max()}).axes.cells(),
          "cell", "cells"),
      Count(sweep.axes_size(), "axis", "axes"), Count(sweep.metrics_size(), "metric", "metrics"));
  v1::Job job;
  *job.mutable_sweep() = sweep;
  return job;
}

// Checks a scenario and prints what it has. Returns a job with it.
v1::Job ValidateScenario(const ValidateArguments& arguments, const std::string& text) {
  const ScenarioFile file = Checked({arguments.file == "-" ? "<stdin>" : arguments.file, text,
                                     ParseVariables(arguments.variables)},
                                    arguments.overrides);
  TellAdvice(file);
  const v1::Scenario& scenario = file.scenario();
  fmt::print("{}: valid; {}, {}, {}, {}, {}\n", arguments.file,
             Count(scenario.bodies_size(), "body", "bodies"),
             Count(CountContacts(scenario), "contact", "contacts"),
             Count(scenario.supports_size(), "support", "supports"),
             Count(scenario.loads_size(), "load", "loads"), Seconds(scenario.end_time_s()));
  v1::Job job;
  *job.mutable_scenario() = scenario;
  return job;
}

ExitCode Validate(const ValidateArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable});
  const std::string text = ReadText(arguments.file);
  const v1::Job job =
      IsSweep(text) ? ValidateSweep(arguments, text) : ValidateScenario(arguments, text);
  if (arguments.on_server) ValidateOnServer(job, settings);
  return ExitCode::kOk;
}

void WriteFile(const std::string& path, std::string_view text, bool force) {
  if (!force && std::filesystem::exists(path)) {
    throw Failure(ExitCode::kLocal, path + " exists already; --force replaces it");
  }
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) {
    throw Failure(ExitCode::kLocal,
                  fmt::format("cannot write {}: {}", path, std::generic_category().message(errno)));
  }
}

// Writes the scenario that a sweep names beside it, unless a file of this name exists.
void WriteBase(const Template& sweep, const std::string& path) {
  for (const Template& scenario : Templates()) {
    const std::string name = std::string(scenario.name) + ".yaml";
    if (sweep.text.find("\nbase: " + name) == std::string_view::npos) continue;
    const std::string base = std::filesystem::path(path).replace_filename(name).string();
    if (std::filesystem::exists(base)) continue;
    WriteFile(base, scenario.text, false);
    fmt::print("{}\n", base);
  }
}

void ListTemplates(const Settings& settings) {
  Table table({{"TEMPLATE"}, {"SHOWS"}});
  for (const Template& scenario : Templates()) {
    table.Add({std::string(scenario.name), std::string(scenario.shows)});
  }
  fmt::print("{}", table.Text(settings.OutputStyle()));
  Tell("Next:  contactctl init {}\n", Templates().front().name);
}

void WriteTemplate(const Template& scenario, const std::string& path, bool force) {
  WriteFile(path, scenario.text, force);
  fmt::print("{}\n", path);
  const bool sweep = IsSweep(std::string(scenario.text));
  if (sweep) WriteBase(scenario, path);
  Tell(
      "Next:  contactctl {} {}\n"
      "       contactctl schema {}  (beside it, for your editor)\n",
      sweep ? "sweep run" : "run", path,
      sweep ? "sweep > contact-sweep.schema.json" : "> contact.schema.json");
}

ExitCode Init(const InitArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kName});
  if (arguments.list || arguments.name.empty()) {
    ListTemplates(settings);
    return ExitCode::kOk;
  }
  const Template& scenario = FindTemplate(arguments.name);
  if (arguments.file == "-") {
    fmt::print("{}", scenario.text);
    return ExitCode::kOk;
  }
  WriteTemplate(scenario, arguments.file.empty() ? arguments.name + ".yaml" : arguments.file,
                arguments.force);
  return ExitCode::kOk;
}

}  // namespace

void AddValidate(CommandLine& line, CLI::App& command) {
  auto arguments = std::make_shared<ValidateArguments>();
  AddOption(line, command, "FILE", &arguments->file, ValueKind::kScenarioFile,
            "Scenario or sweep in YAML or JSON; - is the standard input")
      ->required();
  Repeatable(AddOption(line, command, "--set", &arguments->overrides, ValueKind::kAssignment,
                       "Override a field first; repeatable"));
  AddVariableFlag(command, &arguments->variables);
  command.add_flag("--on-server", arguments->on_server,
                   "Ask the server too: whether it would take it, and what that would take");
  line.SetAction(command, arguments, Validate);
}

void AddInit(CommandLine& line, CLI::App& command) {
  auto arguments = std::make_shared<InitArguments>();
  AddOption(line, command, "TEMPLATE", &arguments->name, ValueKind::kTemplate,
            "Its name; without it all are listed");
  AddOption(line, command, "--file", &arguments->file, ValueKind::kFile,
            "Where to; - is the standard output");
  command.add_flag("--list", arguments->list, "List the templates");
  command.add_flag("--force", arguments->force, "Replace a file that exists");
  line.SetAction(command, arguments, Init);
}

}  // namespace contact::cli
