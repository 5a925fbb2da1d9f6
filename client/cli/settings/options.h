#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/base/scalar.h"
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

/// The check that a number is not below `least`. CLI11's own name the largest double in full.
inline CLI::Validator AtLeast(int least) {
  return {[least](const std::string& text) {
            const std::optional<double> number = ParseNumber(text);
            return number && *number >= least
                       ? std::string()
                       : fmt::format("is {}; must be a number of at least {}", text, least);
          },
          ""};
}

/// Adds a flag for a number > 0.
inline CLI::Option* AddCount(CLI::App& command, const std::string& names, int* count,
                             const std::string& about) {
  return command.add_option(names, *count, about)->check(AtLeast(1))->type_name("N");
}

/// Lets a flag be given several times, each time with one value. Returns the flag.
inline CLI::Option* Repeatable(CLI::Option* flag) {
  return flag->take_all()->allow_extra_args(false);
}

/// Adds --var, whose texts are for ParseVariables.
inline void AddVariableFlag(CLI::App& command, std::vector<std::string>* assignments) {
  Repeatable(command.add_option(
                 "--var", *assignments,
                 "Give a variable of the file another value, such as restitution=0.7; repeatable"))
      ->type_name("VARIABLE=VALUE");
}

}  // namespace contact::cli
