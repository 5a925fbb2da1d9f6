#include "cli/input/checked_scenario.h"

#include <fmt/format.h>

#include <cstdio>

#include "cli/base/failure.h"

namespace contact::cli {

void RequireNoMistakes(const ScenarioFile& file) {
  const std::vector<Diagnostic> mistakes = file.diagnostics();
  if (mistakes.empty()) return;
  std::string text;
  for (const Diagnostic& mistake : mistakes) text += Format(mistake) + "\n";
  text += mistakes.size() == 1 ? "1 error" : fmt::format("{} errors", mistakes.size());
  throw Failure(ExitCode::kInvalidScenario, text);
}

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
