#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cli/settings/command_line.h"

namespace contact::cli {

/// What the flag --comments does, for the help.
inline constexpr char kCommentsAbout[] =
    "Begin csv with where it comes from, in lines that start with #";

/// Adds an option or positional to `command` and declares what its value names. The parser writes
/// the value to `value`, which must outlive the parsing. `names` and `about` are those of
/// CLI::App::add_option. Returns the option.
template <class Value>
CLI::Option* AddOption(CommandLine& line, CLI::App& command, const std::string& names, Value* value,
                       ValueKind kind, const std::string& about) {
  return line.SetKind(command.add_option(names, *value, about), kind);
}

/// The same for an option that takes one of `words`; another word is a usage error.
inline CLI::Option* AddOption(CommandLine& line, CLI::App& command, const std::string& names,
                              std::string* value, const std::vector<std::string>& words,
                              const std::string& about) {
  return line.SetWords(command.add_option(names, *value, about), words);
}

/// The same for an option that takes several values with commas between them.
inline CLI::Option* AddListOption(CommandLine& line, CLI::App& command, const std::string& names,
                                  std::vector<std::string>* values, ValueKind kind,
                                  const std::string& about) {
  return line.SetKind(command.add_option(names, *values, about)->delimiter(','), kind);
}

/// Adds a flag for a number > 0.
inline CLI::Option* AddCount(CLI::App& command, const std::string& names, int* count,
                             const std::string& about) {
  return command.add_option(names, *count, about)->check(CLI::PositiveNumber)->type_name("N");
}

/// Lets a flag be given several times, each time with one value. Returns the flag.
inline CLI::Option* Repeatable(CLI::Option* flag) {
  return flag->take_all()->allow_extra_args(false);
}

}  // namespace contact::cli
