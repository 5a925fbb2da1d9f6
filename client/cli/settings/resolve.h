#pragma once

#include <CLI/App.hpp>

#include "cli/settings/config.h"
#include "cli/settings/settings.h"

namespace contact::cli {

/// The keys of config files: the global flags of `app`, with '_' for '-', such as `server`.
std::vector<std::string> ConfigKeys(const CLI::App& app);

/// The config files, whose keys must be these; see ReadConfigFiles.
std::vector<ConfigFile> ConfigFilesOf(const CLI::App& app);

/// The environment variable of a key, such as CONTACT_SERVER for `server`.
std::string VariableOf(const std::string& key);

/// Fills the global flags of the parsed `app` that the command line leaves out: from the profile
/// that --profile names on it, else from the environment, else from the profile that is chosen
/// otherwise, else from config files outside of profiles. Keeps in `settings` the origin of each
/// value and what is wrong with variables and files. `settings` must be what the flags of `app`
/// write to.
void ResolveSettings(CLI::App& app, Settings* settings);

}  // namespace contact::cli
