#include "cli/input/checked_scenario.h"

#include <fmt/format.h>

#include <cstdio>

namespace contact::cli {

void RequireNoMistakes(const ScenarioFile& file) { RequireNone(file.diagnostics()); }

void TellAdvice(const ScenarioFile& file) {
  for (const Diagnostic& advice : file.advice()) {
    fmt::print(stderr, "{}\n", Format(advice, "warning"));
  }
}

ScenarioFile OpenChecked(const std::string& path, const std::vector<std::string>& overrides,
                         const ScenarioLimits& limits, const VariableValues& variables) {
  ScenarioFile file = ScenarioFile::Open(path, variables);
  for (const std::string& assignment : overrides) file.Set(assignment);
  file.Check(limits);
  RequireNoMistakes(file);
  return file;
}

}  // namespace contact::cli
