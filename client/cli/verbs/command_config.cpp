#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>

#include "base/replace_file.h"
#include "base/spelling.h"
#include "cli/base/table.h"
#include "cli/base/text_file.h"
#include "cli/settings/config.h"
#include "cli/settings/config_edit.h"
#include "cli/settings/resolve.h"
#include "cli/text/print_job.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

struct ConfigArguments {
  std::string key;
  std::string value;
  bool show_origin = false;
};

using Keys = std::vector<std::string>;

// Mistakes of the files are no reason not to show the rest.
ExitCode TellProblems(const Settings& settings) {
  for (const Problem& problem : settings.problems) {
    fmt::print(stderr, "contactctl: {}\n", problem.text);
  }
  return settings.problems.empty() ? ExitCode::kOk : settings.problems.front().code;
}

std::string ValueOf(const CLI::App& app, std::string key) {
  std::ranges::replace(key, '_', '-');
  const CLI::Option* option = app.get_option("--" + key);
  return option->count() > 0 ? option->results().back() : option->get_default_str();
}

std::string OriginOf(const Settings& settings, const std::string& key) {
  const auto found = settings.origins.find(key);
  return found == settings.origins.end() ? "default" : found->second;
}

ExitCode View(const CLI::App& app, const ConfigArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson});
  nlohmann::ordered_json json;
  Table table(arguments.show_origin ? std::vector<Table::Column>{{"KEY"}, {"VALUE"}, {"FROM"}}
                                    : std::vector<Table::Column>{{"KEY"}, {"VALUE"}});
  for (const std::string& key : ConfigKeys(app)) {
    const std::string value = ValueOf(app, key);
    const std::string origin = OriginOf(settings, key);
    std::vector<Table::Cell> row = {key, value.empty() ? "-" : value};
    if (arguments.show_origin) row.emplace_back(origin);
    table.Add(std::move(row));
    json[key] = {{"value", value}, {"origin", origin}};
  }
  if (settings.output == OutputFormat::kJson) {
    PrintJson(json.dump(2) + "\n", settings);
  } else {
    fmt::print("{}", table.Text(settings.OutputStyle()));
  }
  return TellProblems(settings);
}

void RequireKey(const std::string& key, const Keys& keys) {
  if (std::ranges::find(keys, key) != keys.end()) return;
  throw Failure(ExitCode::kUsage,
                WithHint(fmt::format("unknown key {}", Quoted(key)),
                         DidYouMean(key, {keys.begin(), keys.end()},
                                    fmt::format("there are {}", fmt::join(keys, ", ")))));
}

ExitCode Get(const CLI::App& app, const std::string& key, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable});
  RequireKey(key, ConfigKeys(app));
  fmt::print("{}\n", ValueOf(app, key));
  return TellProblems(settings);
}

std::string TextOf(const std::string& path) {
  return std::filesystem::exists(path) ? ReadText(path) : "";
}

void Store(const std::string& profile, const std::string& key, const std::string& value) {
  const std::filesystem::path path = UserConfigPath();
  if (path.empty()) throw Failure(ExitCode::kLocal, "there is no home for a config file: set HOME");
  const std::string text = WithValue(TextOf(path), profile, key, value);
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  error = ReplaceFile(path, text);
  if (error) {
    throw Failure(ExitCode::kLocal,
                  fmt::format("cannot write {}: {}", path.string(), error.message()));
  }
  fmt::print(stderr, "{}\n", path.string());
}

// Where the profile is named on the command line, the value becomes one of its.
ExitCode Set(CLI::App& app, const ConfigArguments& arguments, const Settings& settings) {
  RequireKey(arguments.key, ConfigKeys(app));
  const bool profile = OriginOf(settings, "profile") == "--profile";
  std::string flag = arguments.key;
  std::ranges::replace(flag, '_', '-');
  CLI::Option* option = app.get_option("--" + flag);
  option->clear();
  option->add_result(arguments.value);
  try {
    option->run_callback();  // A value that no command would take is not stored.
  } catch (const CLI::Error& error) {
    throw Failure(ExitCode::kUsage, error.what());
  }
  Store(profile ? settings.profile : "", arguments.key, arguments.value);
  return ExitCode::kOk;
}

std::set<std::string> Profiles(const Keys& keys) {
  std::set<std::string> names;
  for (const ConfigFile& file : ReadConfigFiles({keys.begin(), keys.end()})) {
    for (const auto& [name, section] : file.profiles) names.insert(name);
  }
  return names;
}

ExitCode Use(const CLI::App& app, const std::string& profile) {
  const std::set<std::string> known = Profiles(ConfigKeys(app));
  if (!profile.empty() && !known.contains(profile)) {
    throw Failure(ExitCode::kUsage,
                  fmt::format("there is no profile {0}; make one: contactctl config set server "
                              "HOST:PORT --profile {1}",
                              Quoted(profile), profile));
  }
  Store("", "profile", profile);
  return ExitCode::kOk;
}

ExitCode ListProfiles(const CLI::App& app, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kName});
  const Keys keys = ConfigKeys(app);
  const auto files = ReadConfigFiles({keys.begin(), keys.end()});
  Table table({{"PROFILE"}, {"SERVER"}, {"IN USE"}});
  for (const std::string& name : Profiles(keys)) {
    if (settings.output == OutputFormat::kName) fmt::print("{}\n", name);
    const auto server = FindValue(files, "server", name);
    table.Add(
        {name, server ? server->text : "-", std::string(name == settings.profile ? "yes" : "")});
  }
  if (settings.output == OutputFormat::kTable) fmt::print("{}", table.Text(settings.OutputStyle()));
  return TellProblems(settings);
}

constexpr char kAbout[] =
    R"(Every global flag is also an environment variable and a line of a config file in TOML: --server is
CONTACT_SERVER and server = "HOST:PORT". The first of these wins: the flag, the variable,
./contact.toml, ~/.config/contact/config.toml, /etc/contact/config.toml. A section [profile.lab] has
the values of a profile, which --profile lab, CONTACT_PROFILE=lab or use_profile = "lab" chooses.)";

void AddKey(CommandLine& line, CLI::App& command, std::string* key) {
  line.SetKind(command.add_option("KEY", *key, "Such as server"), ValueKind::kConfigKey)
      ->required();
}

}  // namespace

void AddConfig(CommandLine& line, CLI::App& config) {
  auto arguments = std::make_shared<ConfigArguments>();
  CLI::App& app = line.app();
  const Settings& settings = line.settings();
  config.footer(kAbout);
  config.require_subcommand(1);
  CLI::App* view = config.add_subcommand("view", "Show all settings as they are now");
  view->add_flag("--show-origin", arguments->show_origin, "Show where each comes from");
  line.SetAction(*view, [&app, arguments, &settings] { return View(app, *arguments, settings); });

  CLI::App* get = config.add_subcommand("get", "Print one setting");
  AddKey(line, *get, &arguments->key);
  line.SetAction(*get, [&app, arguments, &settings] { return Get(app, arguments->key, settings); });

  CLI::App* set = config.add_subcommand(
      "set", "Change a setting in the user's file; with --profile, one of that profile");
  AddKey(line, *set, &arguments->key);
  set->add_option("VALUE", arguments->value, "What it shall be")->required();
  line.SetAction(*set, [&app, arguments, &settings] { return Set(app, *arguments, settings); });

  CLI::App* list = config.add_subcommand("list", "List the profiles");
  line.SetAction(*list, [&app, &settings] { return ListProfiles(app, settings); });

  CLI::App* use = config.add_subcommand("use", "Choose a profile from now on");
  line.SetKind(use->add_option("PROFILE", arguments->value, "Its name; '' chooses none"),
               ValueKind::kProfile)
      ->required();
  line.SetAction(*use, [&app, arguments] { return Use(app, arguments->value); });
}

}  // namespace contact::cli
