#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "contact/v1/job.pb.h"

namespace contact::cli {

/// How far a number may be from that of the baseline: max(absolute, relative · |baseline|).
struct Tolerance {
  double absolute = 1e-12;
  double relative = 1e-6;
};

/// Two or more jobs beside each other; the first is the baseline.
struct JobComparison {
  /// A field of the scenario that is not the same in all.
  struct Parameter {
    std::string path;                 ///< As in a scenario file.
    std::vector<std::string> values;  ///< One a job; empty where the field is not set.
  };

  /// Nothing where a job has no such result.
  using Value = std::variant<std::monostate, double, std::string>;

  struct Result {
    std::string name;  ///< Such as `B1-B2 #1 peak force`.
    std::string unit;  ///< Empty for words, `1` without dimension.
    std::vector<Value> values;
    bool judged = true;  ///< False for what a run cost.

    /// True unless a judged value of this job is out of tolerance.
    bool Holds(std::size_t job, const Tolerance& allowed) const;
    /// Relative to the baseline, absolute where that is 0; NaN unless both are numbers.
    double Deviation(std::size_t job) const;
  };

  std::vector<std::string> names;
  std::vector<Parameter> parameters;
  std::vector<Result> results;
  Tolerance tolerance;

  bool Holds() const;
};

JobComparison Compare(const std::vector<v1::Job>& jobs, const Tolerance& tolerance);

}  // namespace contact::cli
