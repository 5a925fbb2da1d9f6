#pragma once

#include <string>
#include <string_view>

namespace contact::cli {

/// A mistake in a scenario, and where it stands.
struct Diagnostic {
  std::string source;  ///< The file, or `--set`.
  int line = 0;        ///< From 1; 0 if there is no line.
  int column = 0;      ///< From 1.
  std::string field;   ///< Path; may be empty.
  std::string what;
  std::string hint;  ///< May be empty.
};

/// `file:line:col: field: what — hint`, or `file:line:col: kind: field: …`.
std::string Format(const Diagnostic& diagnostic, std::string_view kind = {});

}  // namespace contact::cli
