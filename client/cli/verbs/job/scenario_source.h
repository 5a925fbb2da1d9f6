#pragma once

#include <string>
#include <vector>

#include "cli/input/scenario_file.h"
#include "cli/link/client.h"
#include "cli/settings/command_line.h"

namespace contact::cli {

/// The scenario that `run` and `submit` take: a file, a shipped template, or that of an earlier
/// job. Flags change its variables and fields.
class ScenarioSource {
 public:
  /// Adds FILE, --like, --template, --set and --var. This object must outlive the parsing.
  void AddTo(CommandLine& line, CLI::App& command);

  /// Reads and checks the scenario. Only --like asks the server; if another server ran that job, a
  /// note on the standard error says that last digits may differ. Throws Failure: kUsage unless
  /// exactly one source was named, or if that is a sweep; kInvalidScenario with every mistake;
  /// kLocal for a file that cannot be read. Throws CallFailure.
  ScenarioFile Open(Client& client) const;

 private:
  /// Reads the source that was named, before --set and without a check of the rules.
  ScenarioFile Read(Client& client) const;
  /// The scenario of the job that --like names.
  ScenarioFile ReadJob(Client& client) const;
  /// The shipped scenario that --template names.
  ScenarioFile ReadTemplate() const;

  std::string file_;                    // Path, or `-` for the standard input.
  std::string like_;                    // A job, as FindJob takes it.
  std::string template_;                // Name of a shipped scenario.
  std::vector<std::string> overrides_;  // FIELD=VALUE
  std::vector<std::string> variables_;  // NAME=VALUE
};

}  // namespace contact::cli
