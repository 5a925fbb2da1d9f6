#include "cli/help/usage.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>
#include <vector>

#include "base/spelling.h"

namespace contact::cli {
namespace {

std::vector<std::string> Known(const CLI::App& app, bool flags) {
  std::vector<std::string> names;
  for (const CLI::App* scope = &app; flags && scope != nullptr; scope = scope->get_parent()) {
    for (const CLI::Option* option : scope->get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
  }
  if (flags) return names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

// The innermost command that the parsed words name.
const CLI::App& Innermost(const CLI::App& app) {
  const CLI::App* scope = &app;
  while (!scope->get_subcommands().empty()) scope = scope->get_subcommands().front();
  return *scope;
}

std::string FullName(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return parent == nullptr ? command.get_name() : FullName(*parent) + " " + command.get_name();
}

std::string WhatIsWrong(const CLI::App& app, const CLI::App& scope, const CLI::ParseError& error) {
  const std::vector<std::string> extras = app.remaining(true);
  const bool group = !scope.get_subcommands({}).empty();
  if (extras.empty() || (&scope != &app && !group && !extras.front().starts_with("-"))) {
    return error.what();
  }
  const std::string& extra = extras.front();
  const bool flag = extra.starts_with("-");
  const std::vector<std::string> known = Known(scope, flag);
  return WithHint(fmt::format("unknown {} {}", flag ? "flag" : "command", Quoted(extra)),
                  DidYouMean(extra.substr(0, extra.find('=')), {known.begin(), known.end()}));
}

}  // namespace

std::string UsageMessage(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& scope = Innermost(app);
  return fmt::format("{}\nSee {} --help.", WhatIsWrong(app, scope, error), FullName(scope));
}

std::string HelpOf(CLI::App& app, const std::vector<std::string>& names) {
  CLI::App* command = &app;
  std::string before;  // The names of the commands that lead there.
  for (const std::string& name : names) {
    const std::vector<std::string> known = Known(*command, false);
    if (std::ranges::find(known, name) == known.end()) {
      throw Failure(ExitCode::kUsage, WithHint(fmt::format("unknown command {}", Quoted(name)),
                                               DidYouMean(name, {known.begin(), known.end()})));
    }
    before = FullName(*command);
    command = command->get_subcommand(name);
  }
  return command->help(before);
}

}  // namespace contact::cli
