#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace contact::cli {

/// A mistake in a scenario or sweep, and where it stands.
struct Diagnostic {
  std::string source;  ///< The file, or the flag.
  int line = 0;        ///< From 1; 0 if there is no line.
  int column = 0;      ///< From 1.
  std::string field;   ///< Path; may be empty.
  std::string what;    ///< What is wrong.
  std::string hint;    ///< May be empty.
};

/// `file:line:col: field: what — hint`, or `file:line:col: kind: field: …`.
std::string Format(const Diagnostic& diagnostic, std::string_view kind = {});

/// Throws Failure (kInvalidScenario) with a line for each mistake and their number, if there are
/// any.
void RequireNone(const std::vector<Diagnostic>& mistakes);

}  // namespace contact::cli
