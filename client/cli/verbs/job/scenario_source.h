#pragma once

#include <string>
#include <variant>
#include <vector>

#include "cli/input/scenario_file.h"
#include "cli/link/client.h"
#include "cli/settings/command_line.h"

namespace contact::cli {

/// The scenario or sweep that `run` and `submit` take: a file, a shipped template, or that of an
/// earlier job. Flags change its variables and, of a scenario, its fields.
class ScenarioSource {
 public:
  /// Adds FILE, --like, --template, --set and --var. This object must outlive the parsing.
  void AddTo(CommandLine& line, CLI::App& command);

  using Spec = std::variant<ScenarioFile, v1::Sweep>;

  /// Reads and checks the scenario or sweep. Only --like asks the server; if another server ran
  /// that job, a note on the standard error says that last digits may differ. Throws Failure:
  /// kUsage unless exactly one source was named, or for --set with a sweep; kInvalidScenario with
  /// every mistake; kLocal for a file that cannot be read. Throws CallFailure.
  Spec Open(Client& client) const;

  /// The same for a verb that takes no sweep: kUsage for one, with the verb that does.
  ScenarioFile OpenScenario(Client& client) const;

 private:
  /// Reads the source that was named, before --set and, of a scenario, without a check of the
  /// rules.
  Spec Read(Client& client) const;
  /// What the job that --like names has computed.
  Spec ReadJob(Client& client) const;
  /// What --template names.
  Spec ReadTemplate() const;

  std::string file_;                    // Path, or `-` for the standard input.
  std::string like_;                    // A job, as FindJob takes it.
  std::string template_;                // Name of a shipped scenario.
  std::vector<std::string> overrides_;  // FIELD=VALUE
  std::vector<std::string> variables_;  // NAME=VALUE
};

}  // namespace contact::cli
