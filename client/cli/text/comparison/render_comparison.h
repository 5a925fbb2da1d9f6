#pragma once

#include <string>

#include "cli/base/style.h"
#include "cli/text/comparison/job_comparison.h"

namespace contact::cli {

/// A comparison for people: the parameters that differ, then the results with their verdicts.
std::string RenderComparison(const JobComparison& comparison, const Style& style);

/// Two LaTeX tabulars, parameters and results. They need no package.
std::string ComparisonLatex(const JobComparison& comparison);

/// A comparison as one JSON document: jobs, tolerance, equal, parameters, results. A number that is
/// not finite is null.
std::string ComparisonJson(const JobComparison& comparison);

/// A comparison as CSV, a line for each parameter and result: kind, name, unit, a value a job, a
/// deviation for each job but the first, verdict. Numbers have all their digits.
std::string ComparisonCsv(const JobComparison& comparison);

}  // namespace contact::cli
