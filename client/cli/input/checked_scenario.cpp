#include "cli/input/checked_scenario.h"

#include "cli/base/message.h"

namespace contact::cli {

void TellAdvice(const ScenarioFile& file) {
  for (const Diagnostic& advice : file.advice()) {
    Tell("{}\n", Format(advice, "warning"));
  }
}

ScenarioFile Checked(ScenarioFile file, const std::vector<std::string>& overrides,
                     const ScenarioLimits& limits) {
  for (const std::string& assignment : overrides) file.Set(assignment);
  file.Check(limits);
  RequireNone(file.diagnostics());
  return file;
}

}  // namespace contact::cli
