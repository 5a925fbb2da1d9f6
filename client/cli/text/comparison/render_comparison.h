#pragma once

#include <string>

#include "cli/base/style.h"
#include "cli/text/comparison/job_comparison.h"

namespace contact::cli {

/// A comparison for people: the parameters that differ, then the results with their verdicts.
std::string RenderComparison(const JobComparison& comparison, const Style& style);

/// Two LaTeX tabulars, parameters and results. They need no package.
std::string ComparisonLatex(const JobComparison& comparison);

}  // namespace contact::cli
