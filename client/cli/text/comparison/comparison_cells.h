#pragma once

#include <string>
#include <vector>

#include "cli/text/comparison/job_comparison.h"

namespace contact::cli {

/// A table of a comparison before it is written as text, LaTeX or HTML.
struct ComparisonCells {
  /// One header for each column.
  std::vector<std::string> headers;
  /// Each row has as many cells as there are headers.
  std::vector<std::vector<std::string>> rows;
};

/// The parameters that differ: `first` and the jobs as headers, `-` where a field is not set.
ComparisonCells ParameterCells(const JobComparison& comparison, const std::string& first);

/// The results, numbers with this many digits: name with unit, value of the baseline, then value
/// and deviation of each other job. `first` and `deviation` are headers.
ComparisonCells ResultCells(const JobComparison& comparison, int digits, const std::string& first,
                            const std::string& deviation);

/// `ok` or `DIFFERS`; empty for a result that is not judged.
std::string VerdictOf(const JobComparison& comparison, const JobComparison::Result& result);

/// The tolerance as a formula.
std::string ToleranceText(const Tolerance& tolerance);

}  // namespace contact::cli
