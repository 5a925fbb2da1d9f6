#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "cli/help/completion.h"
#include "cli/help/usage.h"
#include "cli/settings/options.h"
#include "cli/verbs/verbs.h"

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
     contactctl report JOB OTHER -f report.html
     contactctl paper all -d paper
)";

}  // namespace

void AddHelp(CommandLine& line, CLI::App& command) {
  auto words = std::make_shared<std::vector<std::string>>();
  AddOption(line, command, "COMMAND", words.get(), ValueKind::kCommand,
            "Such as run, or sweep run; tutorial shows the way");
  line.SetAction(command, [words, &app = line.app()] {
    const bool tutorial = words->size() == 1 && words->front() == "tutorial";
    PrintHelp(tutorial ? kTutorial : HelpOf(app, *words));
    return ExitCode::kOk;
  });
}

void AddCompletion(CommandLine& line, CLI::App& command) {
  std::vector<std::string> shells;
  for (const ShellScript& script : ShellScripts()) shells.emplace_back(script.shell);
  auto shell = std::make_shared<std::string>();
  AddOption(line, command, "SHELL", shell.get(), shells, "Which")->type_name("")->required();
  line.SetAction(command, [shell] {
    const auto script = std::ranges::find(ShellScripts(), *shell, &ShellScript::shell);
    fmt::print("{}", script->text);
    return ExitCode::kOk;
  });
}

}  // namespace contact::cli
