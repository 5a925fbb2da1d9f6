#include "cli/text/sweep/sweep_cells.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>
#include <vector>

#include "cli/base/number.h"
#include "wire/sweep/axis_words.h"

namespace contact::cli {
namespace {

// Servers of earlier versions do not count the cycles.
bool IsUntouched(const v1::SweepCell& cell) { return cell.has_cycles() && cell.cycles() == 0; }

}  // namespace

std::string AxisText(const v1::Sweep::Axis& axis, double value, int digits) {
  const std::string_view word = AxisWord(axis, value);
  if (!word.empty()) return std::string(word);
  return digits == 0 ? fmt::to_string(value) : Digits(value, digits);
}

v1::SweepCell::Source SourceOf(const v1::SweepCell& cell, int metric) {
  return metric < cell.sources_size() ? cell.sources(metric) : v1::SweepCell::RESULT;
}

std::string_view SourceWord(v1::SweepCell::Source source) {
  if (source == v1::SweepCell::CUT) return "CUT";
  return source == v1::SweepCell::NO_CONTACT ? "no contact" : "";
}

std::string MetricText(const v1::SweepCell& cell, int metric, int digits) {
  if (const auto word = SourceWord(SourceOf(cell, metric)); !word.empty()) return std::string(word);
  return metric < cell.metrics_size() ? Digits(cell.metrics(metric), digits) : "-";
}

std::string VerdictText(const v1::SweepCell& cell) {
  std::string text = v1::Job::Convergence_Name(cell.convergence());
  if (IsUntouched(cell)) text += ", no contact";
  if (cell.cycles_cut() > 0) text += fmt::format(", {} cut", cell.cycles_cut());
  return text;
}

std::string UnknownMetrics(const v1::Sweep& sweep, const v1::SweepCell& cell) {
  if (IsUntouched(cell)) return "no contact";
  std::vector<std::string> unknown;
  for (int i = 0; i < sweep.metrics_size(); ++i) {
    const std::string_view word = SourceWord(SourceOf(cell, i));
    if (!word.empty()) unknown.push_back(fmt::format("{}: {}", sweep.metrics(i), word));
  }
  return fmt::format("{}", fmt::join(unknown, "; "));
}

}  // namespace contact::cli
