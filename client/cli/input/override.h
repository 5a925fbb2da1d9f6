#pragma once

#include <string>
#include <vector>

#include "cli/input/diagnostic.h"
#include "contact/v1/scenario.pb.h"

namespace contact::cli {

/// Sets the fields that `contacts[*].restitution=0.7` names, or `contacts[B1-B2].restitution=0.7`,
/// and adds their paths, with indices, to `overridden`. Returns the mistakes. Throws Failure
/// (kUsage) if this is no assignment.
std::vector<Diagnostic> Override(const std::string& assignment, v1::Scenario* scenario,
                                 std::vector<std::string>* overridden);

}  // namespace contact::cli
