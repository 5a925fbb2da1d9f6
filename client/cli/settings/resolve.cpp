#include "cli/settings/resolve.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/algorithm/string/case_conv.hpp>
#include <cstdlib>
#include <set>

namespace contact::cli {
namespace {

constexpr char kProfileFlag[] = "--profile";

std::string KeyOf(const CLI::Option& option) {
  std::string key = option.get_lnames().empty() ? "" : option.get_lnames().front();
  std::ranges::replace(key, '-', '_');
  return key;
}

// The value of a key outside of the command line: in the profile that --profile names, else in the
// environment, else in a config file. Who types --profile means its server, whatever was exported.
std::optional<ConfigValue> Elsewhere(const std::string& key, const std::vector<ConfigFile>& files,
                                     const Settings& settings) {
  const auto origin = settings.origins.find(kProfileKey);
  if (origin != settings.origins.end() && origin->second == kProfileFlag) {
    if (const auto value = FindInProfile(files, key, settings.profile)) return value;
  }
  const std::string variable = VariableOf(key);
  const char* value = std::getenv(variable.c_str());
  if (value != nullptr && *value != '\0') return ConfigValue{value, variable};
  return FindValue(files, key, settings.profile);
}

void Resolve(CLI::Option* option, const std::vector<ConfigFile>& files, Settings* settings) {
  const std::string key = KeyOf(*option);
  if (option->count() > 0) {
    settings->origins[key] = "--" + option->get_lnames().front();
    return;
  }
  const auto value = Elsewhere(key, files, *settings);
  if (!value) return;
  try {
    option->add_result(value->text);
    option->run_callback();
    settings->origins[key] = value->origin;
  } catch (const CLI::Error& error) {
    option->clear();
    settings->problems.push_back(
        {ExitCode::kUsage, fmt::format("{}: {}", value->origin, error.what())});
  }
}

void RequireProfile(const std::vector<ConfigFile>& files, Settings* settings) {
  std::set<std::string> known;
  for (const ConfigFile& file : files) {
    for (const auto& [name, section] : file.profiles) known.insert(name);
  }
  if (settings->profile.empty() || known.contains(settings->profile)) return;
  settings->problems.push_back(
      {ExitCode::kUsage,
       fmt::format("{}: there is no profile '{}'{}", settings->origins[kProfileKey],
                   settings->profile,
                   known.empty() ? "; see contactctl config --help"
                                 : fmt::format("; there are {}", fmt::join(known, ", ")))});
}

}  // namespace

std::vector<std::string> ConfigKeys(const CLI::App& app) {
  std::vector<std::string> keys;
  for (const CLI::Option* option : app.get_options()) {
    if (option != app.get_help_ptr() && !KeyOf(*option).empty()) keys.push_back(KeyOf(*option));
  }
  return keys;
}

std::vector<ConfigFile> ConfigFilesOf(const CLI::App& app) {
  const std::vector<std::string> keys = ConfigKeys(app);
  return ReadConfigFiles({keys.begin(), keys.end()});
}

std::string VariableOf(const std::string& key) { return "CONTACT_" + boost::to_upper_copy(key); }

void ResolveSettings(CLI::App& app, Settings* settings) {
  const std::vector<ConfigFile> files = ConfigFilesOf(app);
  for (const ConfigFile& file : files) {
    if (!file.mistake.empty()) settings->problems.push_back({ExitCode::kLocal, file.mistake});
  }
  Resolve(app.get_option(kProfileFlag), files, settings);  // It decides about the others.
  RequireProfile(files, settings);
  for (CLI::Option* option : app.get_options()) {
    const std::string key = KeyOf(*option);
    if (option != app.get_help_ptr() && !key.empty() && key != kProfileKey) {
      Resolve(option, files, settings);
    }
  }
}

}  // namespace contact::cli
