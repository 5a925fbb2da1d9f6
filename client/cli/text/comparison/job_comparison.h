#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "contact/v1/job.pb.h"

namespace contact::cli {

/// How far a number may be from that of the baseline: max(absolute, relative · |baseline|).
struct Tolerance {
  /// In the unit of the number.
  double absolute = 1e-12;
  /// A fraction of |baseline|.
  double relative = 1e-6;
};

/// Two or more jobs beside each other; the first is the baseline.
struct JobComparison {
  /// A field of the scenario that is not the same in all jobs.
  struct Parameter {
    /// As in a scenario file, such as `bodies[0].mass_kg`.
    std::string path;
    /// One value for each job; empty where the field is not set.
    std::vector<std::string> values;
  };

  /// A number, a word such as a state, or nothing where a job has no such result.
  using Value = std::variant<std::monostate, double, std::string>;

  /// One result of all jobs.
  struct Result {
    /// Such as `B1-B2 #1 peak force`.
    std::string name;
    /// Empty for words, `1` for numbers without dimension.
    std::string unit;
    /// One value for each job.
    std::vector<Value> values;
    /// False for what a run cost, such as its wall time, which is shown but not compared.
    bool judged = true;

    /// True unless a judged value of this job is out of tolerance. Words must be equal, and NaN
    /// equals NaN.
    bool Holds(std::size_t job, const Tolerance& allowed) const;
    /// How far the value of this job is from the baseline, relative to |baseline|, or absolute
    /// where the baseline is 0; NaN unless both are numbers.
    double Deviation(std::size_t job) const;
  };

  /// The jobs, `jobs/ID`.
  std::vector<std::string> names;
  /// In the order of their paths.
  std::vector<Parameter> parameters;
  /// In the order in which the jobs have them.
  std::vector<Result> results;
  /// What decides whether a result holds.
  Tolerance tolerance;

  /// True if a result is within the tolerance in all jobs.
  bool Holds(const Result& result) const;
  /// True if all results are within the tolerance in all jobs.
  bool Holds() const;
};

/// Compares jobs that have ended. `jobs` has at least one job, the baseline.
JobComparison Compare(const std::vector<v1::Job>& jobs, const Tolerance& tolerance);

}  // namespace contact::cli
