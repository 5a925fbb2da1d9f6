#pragma once

#include <string>

#include "cli/base/style.h"
#include "cli/text/job_comparison.h"

namespace contact::cli {

/// For people: parameters that differ, then results with their verdicts.
std::string RenderComparison(const JobComparison& comparison, const Style& style);
std::string ComparisonJson(const JobComparison& comparison);
/// A line a parameter or result: kind, name, unit, a value a job, a deviation for each but the
/// first, verdict.
std::string ComparisonCsv(const JobComparison& comparison);
/// Two tabulars for a paper; needs no package.
std::string ComparisonLatex(const JobComparison& comparison);
/// Two tables for a page.
std::string ComparisonHtml(const JobComparison& comparison);

}  // namespace contact::cli
