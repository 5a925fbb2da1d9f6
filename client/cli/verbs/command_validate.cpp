#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/spelling.h"
#include "cli/base/number.h"
#include "cli/input/scenario_file.h"
#include "cli/input/sweep_file.h"
#include "cli/input/yaml_document.h"
#include "cli/link/connect.h"
#include "cli/settings/options.h"
#include "cli/text/print_job.h"
#include "cli/text/render_estimate.h"
#include "cli/text/render_json.h"
#include "cli/verbs/verbs.h"
#include "wire/scenario/contact_codec.h"
#include "wire/sweep/sweep_codec.h"

namespace contact::cli {
namespace {

using Json = nlohmann::ordered_json;

struct ValidateArguments {
  std::string file;
  std::vector<std::string> overrides;
  std::vector<std::string> variables;  // --var
  bool on_server = false;

  std::string Name() const { return file == "-" ? "<stdin>" : file; }
};

// Something of which a valid file has a number.
struct Part {
  const char* one;
  const char* many;
  std::int64_t count;
};

// A file that breaks no rule.
struct ValidFile {
  v1::Job job;  // With the scenario or sweep.
  std::vector<Part> parts;
  std::optional<ScenarioFile> scenario;  // None of a sweep.
};

ValidFile CheckSweepFile(const ValidateArguments& arguments, const std::string& text) {
  if (!arguments.overrides.empty()) {
    throw Failure(ExitCode::kUsage, "--set is for scenarios; a sweep has axes");
  }
  ValidFile file;
  v1::Sweep& sweep = *file.job.mutable_sweep();
  sweep = ReadSweep(arguments.file, text, ParseVariables(arguments.variables));
  const DecodedSweep plan =
      DecodeSweep(sweep, {.max_cells = std::numeric_limits<std::int32_t>::max()});
  file.parts = {{"cell", "cells", plan.axes.cells()},
                {"axis", "axes", sweep.axes_size()},
                {"metric", "metrics", sweep.metrics_size()}};
  return file;
}

ValidFile CheckScenarioFile(const ValidateArguments& arguments, const std::string& text) {
  ValidFile file;
  const std::string folder = std::filesystem::path(arguments.file).parent_path().string();
  file.scenario = Checked({arguments.Name(), text, ParseVariables(arguments.variables), folder},
                          arguments.overrides);
  const v1::Scenario& scenario = file.scenario->scenario();
  file.parts = {{"body", "bodies", scenario.bodies_size()},
                {"contact", "contacts", CountContacts(scenario)},
                {"support", "supports", scenario.supports_size()},
                {"load", "loads", scenario.loads_size()}};
  *file.job.mutable_scenario() = scenario;
  return file;
}

ValidFile Check(const ValidateArguments& arguments) {
  const std::string text = ReadYaml(arguments.file);
  return IsSweep(text) ? CheckSweepFile(arguments, text) : CheckScenarioFile(arguments, text);
}

// Asks the server, whose limits may be narrower than those that are checked here. What it refuses
// is told at its place in the file. Its advice is not shown, because the check here has shown the
// same.
v1::Job AskServer(Client& client, ValidFile* file) {
  v1::CreateJobRequest request;
  *request.mutable_job() = file->job;
  request.set_validate_only(true);
  try {
    return client.Call(&Client::Stub::CreateJob, request);
  } catch (const CallFailure& failure) {
    if (failure.code() != ExitCode::kInvalidScenario || !file->scenario) throw failure.AllTold();
    for (const Violation& violation : failure.violations()) file->scenario->Add(violation);
    RequireNone(file->scenario->diagnostics());
    throw;
  }
}

void PrintWords(const ValidateArguments& arguments, const Settings& settings) {
  ValidFile file = Check(arguments);
  if (file.scenario) TellAdvice(*file.scenario);
  std::vector<std::string> words;
  for (const Part& part : file.parts) words.push_back(Count(part.count, part.one, part.many));
  if (file.scenario) words.push_back(Seconds(file.scenario->scenario().end_time_s()));
  fmt::print("{}: valid; {}\n", arguments.file, fmt::join(words, ", "));
  if (!arguments.on_server) return;
  Client client = Connect(settings);
  const v1::Job checked = AskServer(client, &file);
  const v1::ServerInfo info = client.Call(&Client::Stub::GetServerInfo, v1::GetServerInfoRequest());
  fmt::print("contactd at {} would take it\n{}", client.server(),
             RenderEstimate(checked, info.limits(), settings.OutputStyle()));
}

Json JsonOf(const std::vector<Diagnostic>& diagnostics) {
  Json list = Json::array();
  for (const Diagnostic& diagnostic : diagnostics) {
    const bool placed = diagnostic.line > 0;
    list.push_back({{"file", diagnostic.source},
                    {"line", placed ? Json(diagnostic.line) : Json()},
                    {"column", placed ? Json(diagnostic.column) : Json()},
                    {"field", diagnostic.field},
                    {"message", diagnostic.what},
                    {"hint", diagnostic.hint}});
  }
  return list;
}

// What a valid file has, and what the server says.
void Describe(const ValidateArguments& arguments, const Settings& settings, Json* document) {
  ValidFile file = Check(arguments);
  (*document)["kind"] = file.scenario ? "scenario" : "sweep";
  for (const Part& part : file.parts) (*document)[part.many] = part.count;
  if (file.scenario) (*document)["warnings"] = JsonOf(file.scenario->advice());
  if (!arguments.on_server) return;
  Client client = Connect(settings);
  const v1::Job checked = AskServer(client, &file);
  (*document)["server"] = client.server();
  (*document)["estimate"] = Json::parse(ToJson(checked.estimate()));
}

ExitCode PrintDocument(const ValidateArguments& arguments, const Settings& settings) {
  Json document = {{"file", arguments.Name()}, {"valid", true}, {"errors", Json::array()}};
  ExitCode code = ExitCode::kOk;
  try {
    Describe(arguments, settings, &document);
  } catch (const InvalidFile& invalid) {
    document["valid"] = false;
    document["errors"] = JsonOf(invalid.mistakes());
    code = invalid.code();
  }
  PrintJson(document.dump(2) + "\n", settings);
  return code;
}

ExitCode Validate(const ValidateArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson});
  if (settings.output == OutputFormat::kJson) return PrintDocument(arguments, settings);
  PrintWords(arguments, settings);
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

}  // namespace contact::cli
