#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "cli/settings/settings.h"

namespace contact::cli {

/// What a shell may offer for the last of `words`, those after the program's name: a line each,
/// the candidate and, after a tab, what it is. The last line begins with ':' and says what else:
/// `:files`, `:scenarios` (YAML and JSON files), `:directories`, `:nospace` (the candidate goes on)
/// or `:none`.
///
/// Names of jobs and channels come from the server that the settings and words name; it has
/// 300 ms. Without it there are none.
std::string Complete(CLI::App& app, const std::vector<std::string>& words, Settings* settings);

/// The script that teaches `shell`, one of bash, zsh and fish, to ask this program.
std::string CompletionScript(const std::string& shell);

}  // namespace contact::cli
