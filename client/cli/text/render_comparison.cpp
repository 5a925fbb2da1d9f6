#include "cli/text/render_comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/base/csv.h"
#include "cli/base/html.h"
#include "cli/base/latex.h"
#include "cli/base/number.h"
#include "cli/base/table.h"

namespace contact::cli {
namespace {

using Json = nlohmann::ordered_json;
using Result = JobComparison::Result;
using Value = JobComparison::Value;

std::string Named(const Result& result) {
  if (result.unit.empty() || result.unit == "1") return result.name;
  return fmt::format("{} [{}]", result.name, result.unit);
}

std::string Shown(const Value& value, int digits) {
  if (const auto* number = std::get_if<double>(&value)) return Digits(*number, digits);
  const auto* word = std::get_if<std::string>(&value);
  return word == nullptr ? "-" : *word;
}

void Add(const Value& value, CsvWriter* csv) {
  if (const auto* number = std::get_if<double>(&value)) {
    csv->Add(*number);
  } else {
    csv->Add(Shown(value, 0));
  }
}

std::string Relative(double deviation) {
  if (std::isnan(deviation)) return "";
  if (deviation == 0) return "0";
  return std::abs(deviation) < 1e-3 ? fmt::format("{:+.1e}", deviation)
                                    : fmt::format("{:+.3g} %", 100 * deviation);
}

bool HoldsEverywhere(const JobComparison& comparison, const Result& result) {
  for (std::size_t job = 1; job < comparison.names.size(); ++job) {
    if (!result.Holds(job, comparison.tolerance)) return false;
  }
  return true;
}

Table::Cell Verdict(const JobComparison& comparison, const Result& result) {
  if (!result.judged) return {""};
  return HoldsEverywhere(comparison, result) ? Table::Cell("ok", Tone::kGood)
                                             : Table::Cell("DIFFERS", Tone::kBad);
}

std::string Rule(const Tolerance& tolerance) {
  return fmt::format("max({:g}, {:g} |baseline|)", tolerance.absolute, tolerance.relative);
}

// Cells of a result: name, values, deviations of all but the first.
std::vector<std::string> Cells(const Result& result, int digits) {
  std::vector<std::string> cells{Named(result), Shown(result.values.front(), digits)};
  for (std::size_t job = 1; job < result.values.size(); ++job) {
    cells.push_back(Shown(result.values[job], digits));
    cells.push_back(Relative(result.Deviation(job)));
  }
  return cells;
}

std::vector<std::string> Headers(const JobComparison& comparison, const std::string& first,
                                 const std::string& deviation) {
  std::vector<std::string> headers{first, comparison.names.front()};
  for (std::size_t job = 1; job < comparison.names.size(); ++job) {
    headers.insert(headers.end(), {comparison.names[job], deviation});
  }
  return headers;
}

std::string ParameterTable(const JobComparison& comparison, const Style& style) {
  if (comparison.parameters.empty()) return "The scenarios are the same.\n\n";
  std::vector<Table::Column> columns{{"PARAMETER"}};
  for (const std::string& name : comparison.names) columns.push_back({name, true});
  Table table(std::move(columns));
  for (const auto& parameter : comparison.parameters) {
    std::vector<Table::Cell> row{parameter.path};
    for (const std::string& value : parameter.values) row.emplace_back(value.empty() ? "-" : value);
    table.Add(std::move(row));
  }
  return table.Text(style) + "\n";
}

Json Number(const Value& value) {
  if (const auto* word = std::get_if<std::string>(&value)) return *word;
  const auto* number = std::get_if<double>(&value);
  return number == nullptr || !std::isfinite(*number) ? Json() : Json(*number);
}

std::string LatexRow(const std::vector<std::string>& cells) {
  std::string row;
  for (const std::string& cell : cells) row += (row.empty() ? "" : " & ") + LatexText(cell);
  return row + " \\\\\n";
}

std::string Tabular(const std::vector<std::string>& headers,
                    const std::vector<std::vector<std::string>>& rows) {
  std::string text =
      fmt::format("\\begin{{tabular}}{{l{}}}\n\\hline\n", std::string(headers.size() - 1, 'r'));
  text += LatexRow(headers) + "\\hline\n";
  for (const auto& row : rows) text += LatexRow(row);
  return text + "\\hline\n\\end{tabular}\n";
}

std::vector<std::vector<std::string>> ParameterRows(const JobComparison& comparison) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& parameter : comparison.parameters) {
    rows.push_back({parameter.path});
    for (const auto& value : parameter.values) rows.back().push_back(value.empty() ? "-" : value);
  }
  return rows;
}

std::vector<std::string> ParameterHeaders(const JobComparison& comparison) {
  std::vector<std::string> headers{"Parameter"};
  headers.insert(headers.end(), comparison.names.begin(), comparison.names.end());
  return headers;
}

}  // namespace

std::string RenderComparison(const JobComparison& comparison, const Style& style) {
  std::vector<Table::Column> columns;
  for (const std::string& header : Headers(comparison, "RESULT", "DEVIATION")) {
    columns.push_back({header, !columns.empty()});
  }
  columns.push_back({""});
  Table table(std::move(columns));
  for (const Result& result : comparison.results) {
    std::vector<Table::Cell> row;
    for (std::string& cell : Cells(result, 9)) row.emplace_back(std::move(cell));
    row.push_back(Verdict(comparison, result));
    table.Add(std::move(row));
  }
  const bool holds = comparison.Holds();
  return ParameterTable(comparison, style) +
         table.Text(style, 200, "… {} more results; -o csv prints all") +
         fmt::format(
             "\n{} within {}\n",
             Paint(holds ? "equal" : "DIFFERENT: not all", holds ? Tone::kGood : Tone::kBad, style),
             Rule(comparison.tolerance));
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
    for (const Value& value : result.values) values.push_back(Number(value));
    json["results"].push_back({{"name", result.name},
                               {"unit", result.unit},
                               {"values", std::move(values)},
                               {"judged", result.judged},
                               {"holds", HoldsEverywhere(comparison, result)}});
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
    csv.Add(Verdict(comparison, result).text).EndRow();
  }
  return text;
}

std::string ComparisonLatex(const JobComparison& comparison) {
  std::vector<std::vector<std::string>> rows;
  for (const Result& result : comparison.results) rows.push_back(Cells(result, 7));
  const std::string parameters =
      comparison.parameters.empty()
          ? ""
          : Tabular(ParameterHeaders(comparison), ParameterRows(comparison)) + "\n";
  return parameters + Tabular(Headers(comparison, "Result", "Deviation"), rows);
}

std::string ComparisonHtml(const JobComparison& comparison) {
  std::vector<HtmlRow> parameters;
  for (auto& row : ParameterRows(comparison)) parameters.push_back({std::move(row)});
  std::vector<HtmlRow> results;
  for (const Result& result : comparison.results) {
    results.push_back({Cells(result, 9), !HoldsEverywhere(comparison, result)});
  }
  const std::string differing = parameters.empty()
                                    ? "<p>The scenarios are the same.</p>\n"
                                    : HtmlTable(ParameterHeaders(comparison), parameters);
  return differing + HtmlTable(Headers(comparison, "Result", "Deviation"), results) +
         fmt::format("<p>Marked: not within {}.</p>\n", HtmlText(Rule(comparison.tolerance)));
}

}  // namespace contact::cli
