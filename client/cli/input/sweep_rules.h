#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/input/diagnostic.h"
#include "contact/v1/scenario.pb.h"
#include "wire/rules/violation.h"

namespace contact::cli {

/// The number that a value of an axis stands for: a number, or the word of an enum if the field at
/// `path` of the scenario is one. Nothing for any other text.
std::optional<double> AxisValue(const std::string& path, const std::string& text);

/// Checks the rules of the contract for a sweep and prints on the standard error what they advise.
/// `place` finds where the field of a broken rule was written. Returns the broken rules.
std::vector<Diagnostic> CheckSweep(const v1::Sweep& sweep,
                                   const std::function<Diagnostic(const Violation&)>& place);

}  // namespace contact::cli
