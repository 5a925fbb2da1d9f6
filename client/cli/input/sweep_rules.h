#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/input/diagnostic.h"
#include "cli/input/scenario_file.h"
#include "cli/input/variables.h"
#include "contact/v1/scenario.pb.h"
#include "wire/rules/violation.h"

namespace contact::cli {

/// The number that a value of an axis stands for: a number, or the word of an enum, in either case,
/// if the field at `path` of the scenario is one. Nothing for any other text.
std::optional<double> AxisValue(const std::string& path, const std::string& text);

/// What an axis over a variable sets, where `var:NAME` stands instead of a path.
struct VariableAxis {
  /// The numbers whose value is the variable; none if there is a problem.
  std::vector<std::string> fields = {};
  /// Why the axis sets nothing; else empty.
  std::string problem = {};
  /// What to do about that.
  std::string hint = {};
};

/// Reads the field of an axis. Nothing if it is no variable.
std::optional<VariableAxis> FindVariableAxis(const std::string& field,
                                             const VariableFields& variables);

/// Checks the rules of the contract for a sweep and prints on the standard error what they advise.
/// Returns the broken rules. Those within the base are told where `base` has the field, if it is
/// not null: it must then be the scenario of the sweep. `place` finds the places of the others.
std::vector<Diagnostic> CheckSweep(const v1::Sweep& sweep, const ScenarioFile* base,
                                   const std::function<Diagnostic(const Violation&)>& place);

}  // namespace contact::cli
