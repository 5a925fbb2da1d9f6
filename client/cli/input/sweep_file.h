#pragma once

#include <string>

#include "cli/input/variables.h"
#include "contact/v1/scenario.pb.h"

namespace contact::cli {

/// Reads a sweep file: the message Sweep in YAML, whose `base` may also be the name of a scenario
/// file, from the folder of the sweep file. The field of an axis may be `var:NAME`, for the fields
/// whose value is the variable of this name. Checks the rules of the contract. Throws Failure:
/// kInvalidScenario, which lists every mistake at its place, or kLocal.
///
/// `variables` are those of the file or of its base; the file has the first claim on a name. Throws
/// Failure (kUsage) for a variable that neither has. Prints advice on the standard error.
v1::Sweep OpenSweep(const std::string& path, const VariableValues& variables = {});

/// Reads a sweep as OpenSweep does, from the text of the file at `path`.
v1::Sweep ReadSweep(const std::string& path, const std::string& text,
                    const VariableValues& variables = {});

/// Reads the shipped sweep of this name; its base may be the name of a shipped scenario's file.
v1::Sweep OpenSweepTemplate(const std::string& name, const VariableValues& variables = {});

/// True if a document has a part that only a sweep has: `base` or `axes`.
bool IsSweep(const std::string& text);

}  // namespace contact::cli
