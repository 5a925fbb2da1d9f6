#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace contact::cli {

/// A mistake in a scenario or sweep, and where it stands.
struct Diagnostic {
  /// The file, or the flag, such as --set.
  std::string source;
  /// Line in the file, from 1; 0 if there is no line.
  int line = 0;
  /// Column in the line, from 1.
  int column = 0;
  /// Path of the field, such as `bodies[0].mass_kg`; empty if it is about no field.
  std::string field;
  /// What is wrong, without a full stop.
  std::string what;
  /// What to do about it; may be empty.
  std::string hint;
};

/// `file:line:col: field: what — hint`, or `file:line:col: kind: field: …`.
std::string Format(const Diagnostic& diagnostic, std::string_view kind = {});

/// Throws Failure (kInvalidScenario) with a line for each mistake and their number, if there are
/// any.
void RequireNone(const std::vector<Diagnostic>& mistakes);

}  // namespace contact::cli
