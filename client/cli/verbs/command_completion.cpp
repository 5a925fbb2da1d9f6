#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/help/completion.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {

void AddCompletion(CommandLine& line, CLI::App& command) {
  std::vector<std::string> shells;
  for (const ShellScript& script : ShellScripts()) shells.emplace_back(script.shell);
  auto shell = std::make_shared<std::string>();
  line.SetWords(command.add_option("SHELL", *shell, "Which"), shells)->type_name("")->required();
  line.SetAction(command, [shell] {
    const auto script = std::ranges::find(ShellScripts(), *shell, &ShellScript::shell);
    fmt::print("{}", script->text);
    return ExitCode::kOk;
  });
}

}  // namespace contact::cli
