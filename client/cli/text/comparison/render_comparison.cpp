#include "cli/text/comparison/render_comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "cli/base/csv.h"
#include "cli/base/escape.h"
#include "cli/base/number.h"
#include "cli/base/table.h"

namespace contact::cli {
namespace {

using Json = nlohmann::ordered_json;
using Result = JobComparison::Result;
using Value = JobComparison::Value;

constexpr std::size_t kMostResults = 200;

// A table of a comparison before it is written as text or LaTeX.
struct Cells {
  std::vector<std::string> headers;            // One for each column.
  std::vector<std::vector<std::string>> rows;  // Each has as many cells as there are headers.
};

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

// The parameters that differ: `first` and the jobs as headers, `-` where a field is not set.
Cells ParameterCells(const JobComparison& comparison, const std::string& first) {
  Cells cells{{first}, {}};
  cells.headers.insert(cells.headers.end(), comparison.names.begin(), comparison.names.end());
  for (const auto& parameter : comparison.parameters) {
    std::vector<std::string> row{parameter.path};
    for (const auto& value : parameter.values) row.push_back(value.empty() ? "-" : value);
    cells.rows.push_back(std::move(row));
  }
  return cells;
}

// The results, numbers with this many digits: name with unit, value of the baseline, then value
// and deviation of each other job. `first` and `deviation` are headers.
Cells ResultCells(const JobComparison& comparison, int digits, const std::string& first,
                  const std::string& deviation) {
  Cells cells{{first, comparison.names.front()}, {}};
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

// `ok` or `DIFFERS`; empty for a result that is not judged.
std::string VerdictOf(const JobComparison& comparison, const Result& result) {
  if (!result.judged) return "";
  return comparison.Holds(result) ? "ok" : "DIFFERS";
}

std::vector<Table::Column> Columns(const std::vector<std::string>& headers) {
  std::vector<Table::Column> columns;
  for (const std::string& header : headers) columns.push_back({header, !columns.empty()});
  return columns;
}

std::string ParameterTable(const JobComparison& comparison, const Style& style) {
  if (comparison.parameters.empty()) return "The scenarios are the same.\n";
  Cells cells = ParameterCells(comparison, "PARAMETER");
  Table table(Columns(cells.headers));
  for (auto& row : cells.rows) table.Add({row.begin(), row.end()});
  return table.Text(style);
}

Tone ToneOfVerdict(const std::string& verdict) {
  if (verdict.empty()) return Tone::kPlain;
  return verdict == "ok" ? Tone::kGood : Tone::kBad;
}

std::string ResultTable(const JobComparison& comparison, const Style& style) {
  Cells cells = ResultCells(comparison, 9, "RESULT", "DEVIATION");
  std::vector<Table::Column> columns = Columns(cells.headers);
  columns.push_back({""});
  Table table(std::move(columns));
  for (std::size_t i = 0; i < cells.rows.size(); ++i) {
    std::vector<Table::Cell> row(cells.rows[i].begin(), cells.rows[i].end());
    const std::string verdict = VerdictOf(comparison, comparison.results[i]);
    row.emplace_back(verdict, ToneOfVerdict(verdict));
    table.Add(std::move(row));
  }
  return table.Text(style, kMostResults, "… {} more results; -o csv prints all");
}

std::string LatexRow(std::vector<std::string> cells) {
  std::ranges::transform(cells, cells.begin(), LatexText);
  return fmt::format("{} \\\\\n", fmt::join(cells, " & "));
}

std::string Tabular(const Cells& cells) {
  std::string text = fmt::format("\\begin{{tabular}}{{l{}}}\n\\hline\n",
                                 std::string(cells.headers.size() - 1, 'r'));
  text += LatexRow(cells.headers) + "\\hline\n";
  for (const auto& row : cells.rows) text += LatexRow(row);
  return text + "\\hline\n\\end{tabular}\n";
}

void Add(const Value& value, CsvWriter* csv) {
  if (const auto* number = std::get_if<double>(&value)) {
    csv->Add(*number);
  } else {
    const auto* word = std::get_if<std::string>(&value);
    csv->Add(word == nullptr ? "-" : *word);
  }
}

Json JsonOf(const Value& value) {
  if (const auto* word = std::get_if<std::string>(&value)) return *word;
  const auto* number = std::get_if<double>(&value);
  return number == nullptr || !std::isfinite(*number) ? Json() : Json(*number);
}

}  // namespace

std::string RenderComparison(const JobComparison& comparison, const Style& style) {
  const bool holds = comparison.Holds();
  return fmt::format(
      "{}\n{}\n{} within max({:g}, {:g} |baseline|)\n", ParameterTable(comparison, style),
      ResultTable(comparison, style),
      Paint(holds ? "equal" : "DIFFERENT: not all", holds ? Tone::kGood : Tone::kBad, style),
      comparison.tolerance.absolute, comparison.tolerance.relative);
}

std::string ComparisonLatex(const JobComparison& comparison) {
  const std::string parameters =
      comparison.parameters.empty() ? "" : Tabular(ParameterCells(comparison, "Parameter")) + "\n";
  return parameters + Tabular(ResultCells(comparison, 7, "Result", "Deviation"));
}

std::string ComparisonJson(const JobComparison& comparison) {
  Json json;
  json["jobs"] = comparison.names;
  json["tolerance"] = {{"absolute", comparison.tolerance.absolute},
                       {"relative", comparison.tolerance.relative}};
  json["equal"] = comparison.Holds();
  json["parameters"] = Json::array();
  for (const auto& [path, values] : comparison.parameters) {
    json["parameters"].push_back({{"path", path}, {"values", values}});
  }
  json["results"] = Json::array();
  for (const Result& result : comparison.results) {
    Json values = Json::array();
    for (const Value& value : result.values) values.push_back(JsonOf(value));
    json["results"].push_back({{"name", result.name},
                               {"unit", result.unit},
                               {"values", std::move(values)},
                               {"judged", result.judged},
                               {"holds", comparison.Holds(result)}});
  }
  return json.dump(2) + "\n";
}

std::string ComparisonCsv(const JobComparison& comparison) {
  const std::size_t jobs = comparison.names.size();
  std::string text;
  CsvWriter csv(&text);
  csv.Add("kind").Add("name").Add("unit");
  for (const std::string& name : comparison.names) csv.Add(name);
  for (std::size_t job = 1; job < jobs; ++job) csv.Add("deviation of " + comparison.names[job]);
  csv.Add("verdict").EndRow();
  for (const auto& parameter : comparison.parameters) {
    csv.Add("parameter").Add(parameter.path).Add("");
    for (const std::string& value : parameter.values) csv.Add(value);
    for (std::size_t job = 0; job < jobs; ++job) csv.Add("");  // No deviations and no verdict.
    csv.EndRow();
  }
  for (const Result& result : comparison.results) {
    csv.Add("result").Add(result.name).Add(result.unit);
    for (const Value& value : result.values) Add(value, &csv);
    for (std::size_t job = 1; job < jobs; ++job) {
      const double deviation = result.Deviation(job);
      std::isnan(deviation) ? csv.Add("") : csv.Add(deviation);
    }
    csv.Add(VerdictOf(comparison, result)).EndRow();
  }
  return text;
}

}  // namespace contact::cli
