#include <fmt/format.h>

#include <memory>
#include <utility>

#include "base/spelling.h"
#include "cli/base/scalar.h"
#include "cli/settings/options.h"
#include "cli/text/print_job.h"
#include "cli/verbs/laws/law_commands.h"
#include "cli/verbs/laws/translation_table.h"

namespace contact::cli {
namespace {

using translate::Setup;
using translate::Tool;
using translate::ToolParameter;
using translate::Tools;
using translate::Translation;
using translate::Wanted;

struct TranslateArguments {
  std::vector<std::string> tools;
  std::string from;
  std::vector<std::string> values;
  std::vector<double> velocities;
  double restitution = 0, stiffness = 0, exponent = 1.5, contact_time = 0;
  double mass = 0, gravity = 0, radius = 0, step = 0;
};

void Require(bool holds, const std::string& what) {
  if (!holds) throw Failure(ExitCode::kUsage, what);
}

void CheckNumbers(const TranslateArguments& given) {
  const std::pair<const char*, double> numbers[] = {{"--restitution", given.restitution},
                                                    {"--stiffness", given.stiffness},
                                                    {"--exponent", given.exponent},
                                                    {"--contact-time", given.contact_time},
                                                    {"--mass", given.mass},
                                                    {"--gravity", given.gravity},
                                                    {"--radius", given.radius},
                                                    {"--step", given.step}};
  for (const auto& [flag, value] : numbers) {
    Require(value >= 0 && value <= 1e30, fmt::format("{} must be from 0 to 1e30", flag));
  }
  for (const double v : given.velocities) {
    Require(v > 0 && v <= 1e30, "--velocity must be above 0, and at most 1e30");
  }
}

void Check(const TranslateArguments& given) {
  CheckNumbers(given);
  Require(given.mass > 0, "--mass must be given, in kg");
  Require(!given.velocities.empty(), "--velocity must be given, in m/s");
  Require(given.exponent >= 1, "--exponent must be at least 1");
  if (!given.from.empty()) {
    Require(given.restitution == 0 && given.stiffness == 0 && given.contact_time == 0,
            "--restitution, --stiffness and --contact-time follow from --from");
    return;
  }
  Require(given.values.empty(), "--set needs --from");
  Require(given.velocities.size() == 1, "several values of --velocity need --from");
  Require(given.restitution >= 0.01 && given.restitution <= 1,
          "--restitution must be given, from 0.01 to 1");
  Require((given.stiffness > 0) != (given.contact_time > 0),
          "either --stiffness or --contact-time must be given");
}

const Tool& ToolNamed(const std::string& name) {
  const Tool* tool = translate::FindTool(name);
  Require(tool != nullptr,
          WithHint(fmt::format("there is no tool {}", Quoted(name)), translate::ToolHint(name)));
  return *tool;
}

Setup SetupAt(const TranslateArguments& given, double velocity) {
  return {
      .collision = {.mass = given.mass, .velocity = velocity, .load = given.mass * given.gravity},
      .radius = given.radius,
      .step = given.step};
}

std::string NamesOf(const Tool& tool) {
  std::string names;
  for (const ToolParameter& parameter : tool.parameters) {
    names += fmt::format("{}{} [{}]", names.empty() ? "" : ", ", parameter.name, parameter.unit);
  }
  return names;
}

// The values of --set in the order of the tool's parameters.
std::vector<double> ValuesFor(const Tool& tool, const TranslateArguments& given) {
  auto texts = ParseAssignments(given.values, "--set", "PARAMETER=VALUE");
  std::vector<double> values;
  for (const ToolParameter& parameter : tool.parameters) {
    const auto text = texts.extract(std::string(parameter.name));
    const std::optional<double> number = ParseNumber(text ? text.mapped() : "");
    const double value = number.value_or(-1);
    Require(value >= 0, fmt::format("--set must give numbers for {}", NamesOf(tool)));
    values.push_back(value);
  }
  Require(texts.empty(), fmt::format("{} has the parameters {}", tool.name, NamesOf(tool)));
  Require(values[0] > 0, fmt::format("{} must be above 0", tool.parameters[0].name));
  return values;
}

// What the tool of --from gives back at each velocity.
std::vector<Translation> Rebounds(const TranslateArguments& given) {
  std::vector<Translation> rebounds;
  if (given.from.empty()) return rebounds;
  const Tool& tool = ToolNamed(given.from);
  const std::vector<double> values = ValuesFor(tool, given);
  for (const double velocity : given.velocities) {
    const Setup setup = SetupAt(given, velocity);
    const std::string_view missing = Missing(tool, setup);
    Require(missing.empty(), fmt::format("{} needs --{}", tool.name, missing));
    Require(CanJudge(tool, values, setup),
            "--set: the simulator's spring or damper is none, or damps nearly everything");
    rebounds.push_back(Judge(tool, values, setup));
  }
  return rebounds;
}

// The tools that are named, else all; none beside --from unless named.
std::vector<const Tool*> Targets(const TranslateArguments& given) {
  std::vector<const Tool*> targets;
  for (const std::string& name : given.tools) targets.push_back(&ToolNamed(name));
  if (targets.empty() && given.from.empty()) {
    for (const Tool& tool : Tools()) targets.push_back(&tool);
  }
  return targets;
}

std::vector<Translation> Translations(const TranslateArguments& given,
                                      const std::vector<Translation>& rebounds) {
  Wanted wanted{given.restitution, given.stiffness, given.exponent, given.contact_time};
  const std::vector<const Tool*> targets = Targets(given);
  if (!rebounds.empty()) wanted = WantedOf(rebounds.front());
  std::vector<Translation> all;
  for (const Tool* tool : targets) {
    Require(wanted.restitution > 0, "the bodies do not part: there is nothing to translate");
    all.push_back(Translate(*tool, wanted, SetupAt(given, given.velocities.front())));
    const std::string_view missing = all.back().missing;
    if (!missing.empty()) all.back().warnings.push_back(fmt::format("needs --{}", missing));
  }
  return all;
}

void Print(const TranslateArguments& given, const std::vector<Translation>& rebounds,
           const std::vector<Translation>& translations, const Settings& settings) {
  const Style style = settings.OutputStyle();
  if (!rebounds.empty()) {
    fmt::print("{}", ReboundTable(rebounds, given.velocities).Text(style));
    for (const std::string& warning : rebounds.front().warnings) fmt::print("  - {}\n", warning);
    if (!translations.empty()) fmt::print("\n");
  }
  if (!translations.empty()) fmt::print("{}", TranslationTable(translations).Text(style));
  if (!given.tools.empty()) fmt::print("{}", TranslationLines(translations));
}

ExitCode Run(const TranslateArguments& given, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson});
  Check(given);
  const std::vector<Translation> rebounds = Rebounds(given);
  const std::vector<Translation> translations = Translations(given, rebounds);
  if (settings.output == OutputFormat::kJson) {
    PrintJson(TranslationJson(rebounds, given.velocities, translations), settings);
  } else {
    Print(given, rebounds, translations, settings);
  }
  return ExitCode::kOk;
}

std::vector<std::string> ToolNames() {
  std::vector<std::string> names;
  for (const Tool& tool : Tools()) names.emplace_back(tool.name);
  return names;
}

void AddNumber(CLI::App& command, const std::string& name, double* value, const std::string& unit,
               const std::string& about) {
  command.add_option(name, *value, about)->type_name(unit);
}

}  // namespace

void AddTranslate(CommandLine& line, CLI::App& model) {
  CLI::App* command = model.add_subcommand(
      "translate", "Translate a contact into the parameters of other simulators");
  auto given = std::make_shared<TranslateArguments>();
  line.SuggestWords(command->add_option("TOOL", given->tools, "Simulators. Default: all"),
                    ToolNames())
      ->type_name("");
  AddNumber(*command, "--restitution", &given->restitution, "ε", "Restitution without the load");
  Repeatable(command->add_option("--velocity", given->velocities,
                                 "Approach velocity; several, with commas between, with --from"))
      ->type_name("M/S,…")
      ->delimiter(',');
  AddNumber(*command, "--mass", &given->mass, "KG", "Effective mass, 1/m = 1/m1 + 1/m2");
  AddNumber(*command, "--stiffness", &given->stiffness, "K", "Stiffness k of k δⁿ");
  AddNumber(*command, "--exponent", &given->exponent, "N", "Its exponent n. Default: 1.5");
  AddNumber(*command, "--contact-time", &given->contact_time, "S",
            "Contact time in place of a stiffness");
  AddNumber(*command, "--gravity", &given->gravity, "M/S²",
            "Gravity, which presses the body on a fixed one. Default: 0");
  AddNumber(*command, "--radius", &given->radius, "M", "Effective radius, 1/R = 1/R1 + 1/R2");
  AddNumber(*command, "--step", &given->step, "S", "Time step of the simulator");
  CLI::Option* from = command->add_option(
      "--from", given->from,
      "The other way: what this simulator gives back with --set, and that in the parameters of "
      "TOOL");
  line.SuggestWords(from, ToolNames())->type_name("TOOL");
  Repeatable(command->add_option("--set", given->values, "Parameters of the simulator of --from"))
      ->type_name("PARAMETER=VALUE,…")
      ->delimiter(',');
  line.SetAction(*command, given, Run);
}

}  // namespace contact::cli
