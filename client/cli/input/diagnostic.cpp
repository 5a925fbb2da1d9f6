#include "cli/input/diagnostic.h"

#include <fmt/format.h>

#include "cli/base/failure.h"

namespace contact::cli {

std::string Format(const Diagnostic& diagnostic, std::string_view kind) {
  std::string text = diagnostic.source;
  if (diagnostic.line > 0) text += fmt::format(":{}:{}", diagnostic.line, diagnostic.column);
  if (!kind.empty()) text += fmt::format(": {}", kind);
  if (!diagnostic.field.empty()) text += ": " + diagnostic.field;
  text += ": " + diagnostic.what;
  if (!diagnostic.hint.empty()) text += " — " + diagnostic.hint;
  return text;
}

void RequireNone(const std::vector<Diagnostic>& mistakes) {
  if (mistakes.empty()) return;
  std::string text;
  for (const Diagnostic& mistake : mistakes) text += Format(mistake) + "\n";
  text += mistakes.size() == 1 ? "1 error" : fmt::format("{} errors", mistakes.size());
  throw Failure(ExitCode::kInvalidScenario, text);
}

}  // namespace contact::cli
