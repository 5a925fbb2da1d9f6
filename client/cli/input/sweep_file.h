#pragma once

#include <string>

#include "cli/input/variables.h"
#include "contact/v1/scenario.pb.h"

namespace contact::cli {

/// Reads the text of the sweep file at `path`, or of the `shipped` sweep of this name: the message
/// Sweep in YAML, whose `base` may also be the name of a scenario file, from the folder of the
/// sweep file, or of a shipped one. The field of an axis may be `var:NAME`, for the fields whose
/// value is the variable of this name. Checks the rules of the contract. Throws Failure:
/// kInvalidScenario, which lists every mistake at its place, or kLocal.
///
/// `variables` are those of the file or of its base; the file has the first claim on a name. Throws
/// Failure (kUsage) for a variable that neither has. Prints advice on the standard error.
v1::Sweep ReadSweep(const std::string& path, const std::string& text,
                    const VariableValues& variables = {}, bool shipped = false);

/// True if a document has a part that only a sweep has: `base` or `axes`.
bool IsSweep(const std::string& text);

/// True if a document is no sweep and has the bodies of a scenario.
bool IsScenario(const std::string& text);

}  // namespace contact::cli
