#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>

#include "base/spelling.h"
#include "cli/base/files.h"
#include "cli/base/message.h"
#include "cli/base/table.h"
#include "cli/settings/options.h"
#include "cli/settings/resolve.h"
#include "cli/text/print_job.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

struct ConfigArguments {
  CLI::App* app = nullptr;  // Of the whole command line.
  std::string key;
  std::string value;
  bool show_origin = false;
};

// Prints what is wrong with config files, after the settings that could be read.
ExitCode TellProblems(const Settings& settings) {
  for (const Problem& problem : settings.problems) {
    Tell("contactctl: {}\n", problem.text);
  }
  return settings.problems.empty() ? ExitCode::kOk : settings.problems.front().code;
}

// The global flag of a key.
CLI::Option& FlagOf(CLI::App& app, std::string key) {
  std::ranges::replace(key, '_', '-');
  return *app.get_option("--" + key);
}

// The value in use, as it was written.
std::string ValueOf(CLI::App& app, const std::string& key) {
  const CLI::Option* option = &FlagOf(app, key);
  return option->count() > 0 ? option->results().back() : option->get_default_str();
}

std::string OriginOf(const Settings& settings, const std::string& key) {
  const auto found = settings.origins.find(key);
  return found == settings.origins.end() ? "default" : found->second;
}

ExitCode View(const ConfigArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson});
  nlohmann::ordered_json json;
  std::vector<Table::Column> columns{{"KEY"}, {"VALUE"}};
  if (arguments.show_origin) columns.push_back({"FROM"});
  Table table(std::move(columns));
  for (const std::string& key : ConfigKeys(*arguments.app)) {
    const std::string value = ValueOf(*arguments.app, key);
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

void RequireKey(const std::string& key, const CLI::App& app) {
  const std::vector<std::string> keys = ConfigKeys(app);
  if (std::ranges::find(keys, key) != keys.end()) return;
  throw Failure(ExitCode::kUsage,
                WithHint(fmt::format("unknown key {}", Quoted(key)),
                         DidYouMean(key, {keys.begin(), keys.end()},
                                    fmt::format("there are {}", fmt::join(keys, ", ")))));
}

ExitCode Get(const ConfigArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable});
  RequireKey(arguments.key, *arguments.app);
  fmt::print("{}\n", ValueOf(*arguments.app, arguments.key));
  return TellProblems(settings);
}

void Store(const std::string& profile, const std::string& key, const std::string& value) {
  const std::filesystem::path path = UserConfigPath();
  if (path.empty()) throw Failure(ExitCode::kLocal, "there is no home for a config file: set HOME");
  const std::string old = std::filesystem::exists(path) ? ReadText(path) : "";
  const std::string text = WithValue(old, profile, key, value);
  std::error_code error;  // That of the file is told.
  std::filesystem::create_directories(path.parent_path(), error);
  ReplaceText(text, path);
  Tell("{}\n", path.string());
}

// With --profile on the command line, stores the value in that profile.
ExitCode Set(const ConfigArguments& arguments, const Settings& settings) {
  RequireKey(arguments.key, *arguments.app);
  const bool profile = OriginOf(settings, "profile") == "--profile";
  CLI::Option& flag = FlagOf(*arguments.app, arguments.key);
  flag.clear();
  flag.add_result(arguments.value);
  try {
    flag.run_callback();  // Refuses a value that no command would take.
  } catch (const CLI::Error& error) {
    throw Failure(ExitCode::kUsage, error.what());
  }
  Store(profile ? settings.profile : "", arguments.key, arguments.value);
  return ExitCode::kOk;
}

std::set<std::string> Profiles(const std::vector<ConfigFile>& files) {
  std::set<std::string> names;
  for (const ConfigFile& file : files) {
    for (const auto& [name, section] : file.profiles) names.insert(name);
  }
  return names;
}

ExitCode Use(const ConfigArguments& arguments, const Settings&) {
  const std::string& profile = arguments.value;
  if (!profile.empty() && !Profiles(ConfigFilesOf(*arguments.app)).contains(profile)) {
    throw Failure(ExitCode::kUsage,
                  fmt::format("there is no profile {0}; make one: contactctl config set server "
                              "HOST:PORT --profile {1}",
                              Quoted(profile), profile));
  }
  Store("", "profile", profile);
  return ExitCode::kOk;
}

ExitCode ListProfiles(const ConfigArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kName});
  const std::vector<ConfigFile> files = ConfigFilesOf(*arguments.app);
  Table table({{"PROFILE"}, {"SERVER"}, {"IN USE"}});
  for (const std::string& name : Profiles(files)) {
    if (settings.output == OutputFormat::kName) fmt::print("{}\n", name);
    const auto server = FindValue(files, "server", name);
    table.Add(
        {name, server ? server->text : "-", std::string(name == settings.profile ? "yes" : "")});
  }
  if (settings.output == OutputFormat::kTable) fmt::print("{}", table.Text(settings.OutputStyle()));
  return TellProblems(settings);
}

constexpr char kAbout[] =
    R"(Every global flag is also an environment variable and a line of a config file in TOML: --server
is CONTACT_SERVER and server = "HOST:PORT". The first of these wins: the flag, the profile that
--profile names, the variable, ./contact.toml, ~/.config/contact/config.toml,
/etc/contact/config.toml. A section [profile.lab] has the values of a profile, which --profile lab,
CONTACT_PROFILE=lab or use_profile = "lab" chooses; chosen by the latter two it wins over values
outside of profiles, not over variables.)";

void AddKey(CommandLine& line, CLI::App& command, std::string* key) {
  AddOption(line, command, "KEY", key, ValueKind::kConfigKey, "Such as server")->required();
}

}  // namespace

void AddConfig(CommandLine& line, CLI::App& config) {
  auto arguments = std::make_shared<ConfigArguments>();
  arguments->app = &line.app();
  config.footer(kAbout);
  config.require_subcommand(1);
  CLI::App* view = config.add_subcommand("view", "Show all settings as they are now");
  view->add_flag("--show-origin", arguments->show_origin, "Show where each comes from");
  line.SetAction(*view, arguments, View);

  CLI::App* get = config.add_subcommand("get", "Print one setting");
  AddKey(line, *get, &arguments->key);
  line.SetAction(*get, arguments, Get);

  CLI::App* set = config.add_subcommand(
      "set", "Change a setting in the user's file; with --profile, one of that profile");
  AddKey(line, *set, &arguments->key);
  set->add_option("VALUE", arguments->value, "The new value")->required();
  line.SetAction(*set, arguments, Set);

  line.SetAction(*config.add_subcommand("list", "List the profiles"), arguments, ListProfiles);

  CLI::App* use = config.add_subcommand("use", "Choose a profile from now on");
  AddOption(line, *use, "PROFILE", &arguments->value, ValueKind::kProfile,
            "Its name; '' chooses none")
      ->required();
  line.SetAction(*use, arguments, Use);
}

}  // namespace contact::cli
