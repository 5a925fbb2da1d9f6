#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <memory>
#include <system_error>

#include "cli/checked_scenario.h"
#include "cli/commands.h"
#include "cli/number.h"
#include "cli/table.h"
#include "cli/templates.h"
#include "wire/contact_codec.h"
#include "wire/spelling.h"

namespace contact::cli {
namespace {

struct ValidateArguments {
  std::string file;
  std::vector<std::string> overrides;
};

struct InitArguments {
  std::string name;
  std::string file;
  bool list = false;
  bool force = false;
};

ExitCode Validate(const ValidateArguments& arguments, const Settings& settings) {
  settings.RequireOutput({"table"});
  const ScenarioFile file = OpenChecked(arguments.file, arguments.overrides);
  const v1::Scenario& scenario = file.scenario();
  fmt::print("{}: valid; {}, {}, {}, {}, {}\n", arguments.file,
             Count(scenario.bodies_size(), "body", "bodies"),
             Count(CountContacts(scenario), "contact", "contacts"),
             Count(scenario.supports_size(), "support", "supports"),
             Count(scenario.loads_size(), "load", "loads"), Seconds(scenario.end_time_s()));
  return ExitCode::kOk;
}

std::string Title(const Template& scenario) {
  return ScenarioFile(std::string(scenario.name), std::string(scenario.text)).scenario().title();
}

const Template& FindTemplate(const std::string& name) {
  std::vector<std::string_view> names;
  for (const Template& scenario : Templates()) {
    if (scenario.name == name) return scenario;
    names.push_back(scenario.name);
  }
  const std::string_view nearest = Nearest(name, names);
  throw Failure(ExitCode::kUsage,
                fmt::format("there is no template {} — {}", Quoted(name),
                            nearest.empty() ? fmt::format("there are {}", fmt::join(names, ", "))
                                            : fmt::format("did you mean '{}'?", nearest)));
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

ExitCode Init(const InitArguments& arguments, const Settings& settings) {
  settings.RequireOutput({"table", "name"});
  if (arguments.list || arguments.name.empty()) {
    Table table({{"TEMPLATE"}, {"SHOWS"}});
    for (const Template& scenario : Templates()) {
      table.Add({std::string(scenario.name), Title(scenario)});
    }
    fmt::print("{}", table.Text(settings.OutputStyle()));
    fmt::print(stderr, "Next:  contactctl init {}\n", Templates().front().name);
    return ExitCode::kOk;
  }
  const Template& scenario = FindTemplate(arguments.name);
  if (arguments.file == "-") {
    fmt::print("{}", scenario.text);
    return ExitCode::kOk;
  }
  const std::string path = arguments.file.empty() ? arguments.name + ".yaml" : arguments.file;
  WriteFile(path, scenario.text, arguments.force);
  fmt::print("{}\n", path);
  fmt::print(stderr,
             "Next:  contactctl run {}\n"
             "       contactctl schema > contact.schema.json  (beside it, for your editor)\n",
             path);
  return ExitCode::kOk;
}

}  // namespace

void AddScenarioCommands(CLI::App& app, const Settings& settings, Action* action) {
  auto scenario = std::make_shared<ValidateArguments>();
  CLI::App* validate = app.add_subcommand("validate", "Check a scenario file, without a server");
  validate->add_option("FILE", scenario->file, "Scenario in YAML or JSON; - is the standard input")
      ->required();
  validate->add_option("--set", scenario->overrides, "Override a field first; repeatable")
      ->type_name("FIELD=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  validate->callback([scenario, &settings, action] {
    *action = [scenario, &settings] { return Validate(*scenario, settings); };
  });

  auto arguments = std::make_shared<InitArguments>();
  CLI::App* init = app.add_subcommand("init", "Write an example scenario to start from");
  init->add_option("TEMPLATE", arguments->name, "Which; without it they are listed");
  init->add_option("--file", arguments->file, "Where to; - is the standard output")
      ->type_name("FILE");
  init->add_flag("--list", arguments->list, "List the templates");
  init->add_flag("--force", arguments->force, "Replace a file that exists");
  init->callback([arguments, &settings, action] {
    *action = [arguments, &settings] { return Init(*arguments, settings); };
  });
}

}  // namespace contact::cli
