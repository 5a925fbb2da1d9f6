#include "cli/input/diagnostic.h"

#include <fmt/format.h>

#include <utility>

#include "base/spelling.h"

namespace contact::cli {
namespace {

std::string Lines(const std::vector<Diagnostic>& mistakes) {
  std::string text;
  for (const Diagnostic& mistake : mistakes) text += Format(mistake) + "\n";
  return text + Count(static_cast<std::int64_t>(mistakes.size()), "error", "errors");
}

}  // namespace

std::string Format(const Diagnostic& diagnostic, std::string_view kind) {
  std::string text = diagnostic.source;
  if (diagnostic.line > 0) text += fmt::format(":{}:{}", diagnostic.line, diagnostic.column);
  if (!kind.empty()) text += fmt::format(": {}", kind);
  if (!diagnostic.field.empty()) text += ": " + diagnostic.field;
  text += ": " + diagnostic.what;
  if (!diagnostic.hint.empty()) text += " — " + diagnostic.hint;
  return text;
}

InvalidFile::InvalidFile(std::vector<Diagnostic> mistakes)
    : Failure(ExitCode::kInvalidScenario, Lines(mistakes)), mistakes_(std::move(mistakes)) {}

void RequireNone(const std::vector<Diagnostic>& mistakes) {
  if (!mistakes.empty()) throw InvalidFile(mistakes);
}

}  // namespace contact::cli
