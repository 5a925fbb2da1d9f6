#include "cli/input/diagnostic.h"

#include <fmt/format.h>

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

}  // namespace contact::cli
