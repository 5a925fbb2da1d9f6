#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/settings/command_line.h"

namespace contact::cli {

/// What a shell may offer for the last of `words`, which are those after the name of the program.
/// One line a candidate: the candidate, a tab, and what it is. The last line begins with ':' and is
/// a rule for the shell: `:files`, `:scenarios` (YAML and JSON files) and `:directories` ask it to
/// offer files too, `:nospace` says that the candidate goes on, `:none` says nothing.
///
/// Names of jobs and channels come from the server that settings and words name. It has 300 ms to
/// answer; without an answer there are none. Never throws Failure.
std::string Complete(CommandLine& line, const std::vector<std::string>& words);

/// A script with which a shell asks this program for candidates; a file of the folder shells.
struct ShellScript {
  /// The name of the shell, such as `bash`.
  std::string_view shell;
  /// The whole script.
  std::string_view text;
};

/// The scripts of all shells that are known.
std::span<const ShellScript> ShellScripts();

}  // namespace contact::cli
