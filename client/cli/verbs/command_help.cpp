#include <fmt/format.h>

#include <memory>
#include <vector>

#include "cli/help/usage.h"
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
  line.SetKind(
      command.add_option("COMMAND", *words, "Such as run, or sweep run; tutorial shows the way"),
      ValueKind::kCommand);
  line.SetAction(command, [words, &app = line.app()] {
    const bool tutorial = words->size() == 1 && words->front() == "tutorial";
    fmt::print("{}", tutorial ? kTutorial : HelpOf(app, *words));
    return ExitCode::kOk;
  });
}

}  // namespace contact::cli
