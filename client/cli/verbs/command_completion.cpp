#include <fmt/format.h>

#include <memory>

#include "cli/help/completion.h"
#include "cli/verbs/commands.h"

namespace contact::cli {

void AddCompletionCommand(CLI::App& app, Action* action) {
  auto shell = std::make_shared<std::string>();
  CLI::App* completion =
      app.add_subcommand("completion", "Print what teaches a shell to complete contactctl's words");
  completion->add_option("SHELL", *shell, "Which")
      ->check(CLI::IsMember({"bash", "zsh", "fish"}))
      ->type_name("")
      ->required();
  completion->callback([shell, action] {
    *action = [shell] {
      fmt::print("{}", CompletionScript(*shell));
      return ExitCode::kOk;
    };
  });
}

}  // namespace contact::cli
