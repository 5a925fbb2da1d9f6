#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/base/failure.h"

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

/// A file that has mistakes: kInvalidScenario, with a line for each and their number.
class InvalidFile : public Failure {
 public:
  /// `mistakes` has at least one.
  explicit InvalidFile(std::vector<Diagnostic> mistakes);

  /// The mistakes, for programs.
  const std::vector<Diagnostic>& mistakes() const { return mistakes_; }

 private:
  std::vector<Diagnostic> mistakes_;
};

/// Throws InvalidFile if there are mistakes.
void RequireNone(const std::vector<Diagnostic>& mistakes);

}  // namespace contact::cli
