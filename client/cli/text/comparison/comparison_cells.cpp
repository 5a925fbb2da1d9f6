#include "cli/text/comparison/comparison_cells.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <utility>

#include "cli/base/number.h"

namespace contact::cli {
namespace {

using Result = JobComparison::Result;
using Value = JobComparison::Value;

std::string NameWithUnit(const Result& result) {
  if (result.unit.empty() || result.unit == "1") return result.name;
  return fmt::format("{} [{}]", result.name, result.unit);
}

std::string Shown(const Value& value, int digits) {
  if (const auto* number = std::get_if<double>(&value)) return Digits(*number, digits);
  const auto* word = std::get_if<std::string>(&value);
  return word == nullptr ? "-" : *word;
}

// A relative deviation, from 0.001 on in per cent; empty for NaN.
std::string Relative(double deviation) {
  if (std::isnan(deviation)) return "";
  if (deviation == 0) return "0";
  return std::abs(deviation) < 1e-3 ? fmt::format("{:+.1e}", deviation)
                                    : fmt::format("{:+.3g} %", 100 * deviation);
}

}  // namespace

ComparisonCells ParameterCells(const JobComparison& comparison, const std::string& first) {
  ComparisonCells cells{{first}, {}};
  cells.headers.insert(cells.headers.end(), comparison.names.begin(), comparison.names.end());
  for (const auto& parameter : comparison.parameters) {
    std::vector<std::string> row{parameter.path};
    for (const auto& value : parameter.values) row.push_back(value.empty() ? "-" : value);
    cells.rows.push_back(std::move(row));
  }
  return cells;
}

ComparisonCells ResultCells(const JobComparison& comparison, int digits, const std::string& first,
                            const std::string& deviation) {
  ComparisonCells cells{{first, comparison.names.front()}, {}};
  for (std::size_t job = 1; job < comparison.names.size(); ++job) {
    cells.headers.insert(cells.headers.end(), {comparison.names[job], deviation});
  }
  for (const Result& result : comparison.results) {
    std::vector<std::string> row{NameWithUnit(result), Shown(result.values.front(), digits)};
    for (std::size_t job = 1; job < result.values.size(); ++job) {
      row.push_back(Shown(result.values[job], digits));
      row.push_back(Relative(result.Deviation(job)));
    }
    cells.rows.push_back(std::move(row));
  }
  return cells;
}

std::string VerdictOf(const JobComparison& comparison, const Result& result) {
  if (!result.judged) return "";
  return comparison.Holds(result) ? "ok" : "DIFFERS";
}

std::string ToleranceText(const Tolerance& tolerance) {
  return fmt::format("max({:g}, {:g} |baseline|)", tolerance.absolute, tolerance.relative);
}

}  // namespace contact::cli
