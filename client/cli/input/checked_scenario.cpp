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

}  // namespace contact::cli
