#include "cli/help/usage.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>
#include <vector>

#include "base/spelling.h"
#include "cli/base/style.h"

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

// The text in parts that a line may end behind.
std::vector<std::string> Breakable(std::string_view text) {
  std::vector<std::string> parts = {""};
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char before = i == 0 ? 'a' : text[i - 1];
    if (before == ',' || (before == ' ' && text[i] != ' ')) parts.emplace_back();
    parts.back() += text[i];
  }
  return parts;
}

// The text folded to the right of `indent` spaces, but for the first line, which begins there.
std::string Indented(std::string_view text, std::size_t indent, int width) {
  const int room = std::max(width - static_cast<int>(indent), 1);
  return fmt::format("{}\n",
                     fmt::join(Fold(Breakable(text), room), "\n" + std::string(indent, ' ')));
}

// A line of a help: a name and what it means, or one of both, behind spaces.
std::string WrapHelpLine(std::string_view line, int width) {
  constexpr std::size_t kBelow = 6, kColumn = 20;  // A meaning without its name begins behind that.
  const bool narrow = width < 60;
  const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
  const std::size_t gap = line.find("  ", begin);
  if (gap == std::string_view::npos) {
    const bool meaning = begin >= kColumn;
    const std::size_t first = meaning && narrow ? kBelow : begin;
    return std::string(first, ' ') +
           Indented(line.substr(begin), meaning ? first : begin + 2, width);
  }
  const std::size_t meaning = line.find_first_not_of(' ', gap);
  if (!narrow) {
    return std::string(line.substr(0, meaning)) + Indented(line.substr(meaning), meaning, width);
  }
  return std::string(begin, ' ') + Indented(line.substr(begin, gap - begin), begin + 2, width) +
         std::string(kBelow, ' ') + Indented(line.substr(meaning), kBelow, width);
}

}  // namespace

std::string WrapHelp(std::string_view text, int width) {
  std::string wrapped;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    wrapped +=
        width == 0 || Width(line) <= width ? std::string(line) + "\n" : WrapHelpLine(line, width);
  }
  return wrapped;
}

void PrintHelp(std::string_view text) {
  fmt::print("{}", WrapHelp(text, StyleOf(STDOUT_FILENO, "never").width));
}

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
