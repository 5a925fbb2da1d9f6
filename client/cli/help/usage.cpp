#include "cli/help/usage.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string_view>
#include <vector>

#include "base/spelling.h"

namespace contact::cli {
namespace {

constexpr char kTutorial[] =
    R"(1. A server of your own, and its address for the commands below:
     contactctl dev &
     export CONTACT_SERVER=127.0.0.1:PORT      as it prints
2. A scenario, checked and solved; the ledger has a row for each contact cycle:
     contactctl init three-ball-chain
     contactctl validate three-ball-chain.yaml
     contactctl run three-ball-chain.yaml
3. Its figures, and its numbers:
     contactctl plot JOB hysteresis
     contactctl export JOB -f chain.nc
4. One thing changed, and what came of it:
     contactctl run --like JOB --set 'contacts[0].restitution=0.6'
     contactctl compare JOB OTHER --plot both.svg
5. Many values at once, on all workers:
     contactctl sweep run three-ball-chain.yaml --grid 'contacts[*].restitution=0.5:0.9:9'
6. A page for others, and the paper made again:
     contactctl report JOB OTHER -o report.html
     contactctl paper all -o paper
)";

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

std::string DidYouMean(const std::string& word, const std::vector<std::string>& known) {
  const std::string_view nearest = Nearest(word, {known.begin(), known.end()});
  return nearest.empty() ? "" : fmt::format(" — did you mean '{}'?", nearest);
}

// Of `--output: tabel not in {table,json}` the nearest of these words.
std::string NearestAllowed(const std::string& message) {
  constexpr std::string_view kBefore = " not in {";
  const std::size_t end = message.find(kBefore);
  const std::size_t begin = message.rfind(": ", end);
  if (end == std::string::npos || begin == std::string::npos) return "";
  std::vector<std::string> words;
  for (std::size_t at = end + kBefore.size(); at < message.size();) {
    const std::size_t stop = std::min(message.find_first_of(",}", at), message.size());
    words.push_back(message.substr(at, stop - at));
    at = stop + 1;
  }
  return DidYouMean(message.substr(begin + 2, end - begin - 2), words);
}

// The command that the words named, as far as they name one.
CLI::App& Innermost(CLI::App& app) {
  CLI::App* scope = &app;
  while (!scope->get_subcommands().empty()) scope = scope->get_subcommands().front();
  return *scope;
}

std::string FullName(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return parent == nullptr ? command.get_name() : FullName(*parent) + " " + command.get_name();
}

std::string WhatIsWrong(CLI::App& app, const CLI::App& scope, const CLI::ParseError& error) {
  const std::vector<std::string> extras = app.remaining(true);
  const bool group = !scope.get_subcommands({}).empty();
  if (extras.empty() || (&scope != &app && !group && !extras.front().starts_with("-"))) {
    return error.what() + NearestAllowed(error.what());
  }
  const std::string& extra = extras.front();
  const bool flag = extra.starts_with("-");
  return fmt::format("unknown {} {}{}", flag ? "flag" : "command", Quoted(extra),
                     DidYouMean(extra.substr(0, extra.find('=')), Known(scope, flag)));
}

ExitCode Help(CLI::App& app, const std::vector<std::string>& words) {
  if (words.size() == 1 && words.front() == "tutorial") {
    fmt::print("{}", kTutorial);
    return ExitCode::kOk;
  }
  CLI::App* command = &app;
  std::string before;  // The names of the commands that lead there.
  for (const std::string& word : words) {
    const std::vector<std::string> known = Known(*command, false);
    if (std::find(known.begin(), known.end(), word) == known.end()) {
      throw Failure(ExitCode::kUsage,
                    fmt::format("unknown command {}{}", Quoted(word), DidYouMean(word, known)));
    }
    before = FullName(*command);
    command = command->get_subcommand(word);
  }
  fmt::print("{}", command->help(before));
  return ExitCode::kOk;
}

}  // namespace

std::string UsageMessage(CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& scope = Innermost(app);
  return fmt::format("{}\nSee {} --help.", WhatIsWrong(app, scope, error), FullName(scope));
}

void AddHelpCommand(CLI::App& app, Action* action) {
  auto words = std::make_shared<std::vector<std::string>>();
  CLI::App* help = app.add_subcommand("help", "Show the help of a command, or a tutorial");
  help->add_option("COMMAND", *words, "Such as run, or sweep run; tutorial shows the way");
  help->callback([words, &app, action] { *action = [words, &app] { return Help(app, *words); }; });
}

}  // namespace contact::cli
