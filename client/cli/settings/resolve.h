#pragma once

#include <CLI/App.hpp>

#include "cli/settings/settings.h"

namespace contact::cli {

/// The keys of config files: the global flags of `app`, with '_' for '-', such as `server`.
std::vector<std::string> ConfigKeys(const CLI::App& app);

/// The environment variable of a key, such as CONTACT_SERVER.
std::string VariableOf(const std::string& key);

/// Fills the global flags that the command line left out: from the environment, else from config
/// files, first those of the profile. Keeps in `settings` where each value comes from, and what
/// was wrong.
void ResolveSettings(CLI::App& app, Settings* settings);

}  // namespace contact::cli
