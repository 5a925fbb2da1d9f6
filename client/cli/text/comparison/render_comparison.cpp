#include "cli/text/comparison/render_comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "cli/base/escape.h"
#include "cli/base/table.h"
#include "cli/text/comparison/comparison_cells.h"

namespace contact::cli {
namespace {

constexpr std::size_t kMostResults = 200;

std::vector<Table::Column> Columns(const std::vector<std::string>& headers) {
  std::vector<Table::Column> columns;
  for (const std::string& header : headers) columns.push_back({header, !columns.empty()});
  return columns;
}

std::string ParameterTable(const JobComparison& comparison, const Style& style) {
  if (comparison.parameters.empty()) return "The scenarios are the same.\n";
  ComparisonCells cells = ParameterCells(comparison, "PARAMETER");
  Table table(Columns(cells.headers));
  for (auto& row : cells.rows) table.Add({row.begin(), row.end()});
  return table.Text(style);
}

Tone ToneOfVerdict(const std::string& verdict) {
  if (verdict.empty()) return Tone::kPlain;
  return verdict == "ok" ? Tone::kGood : Tone::kBad;
}

std::string ResultTable(const JobComparison& comparison, const Style& style) {
  ComparisonCells cells = ResultCells(comparison, 9, "RESULT", "DEVIATION");
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

std::string Tabular(const ComparisonCells& cells) {
  std::string text = fmt::format("\\begin{{tabular}}{{l{}}}\n\\hline\n",
                                 std::string(cells.headers.size() - 1, 'r'));
  text += LatexRow(cells.headers) + "\\hline\n";
  for (const auto& row : cells.rows) text += LatexRow(row);
  return text + "\\hline\n\\end{tabular}\n";
}

}  // namespace

std::string RenderComparison(const JobComparison& comparison, const Style& style) {
  const bool holds = comparison.Holds();
  return fmt::format(
      "{}\n{}\n{} within {}\n", ParameterTable(comparison, style), ResultTable(comparison, style),
      Paint(holds ? "equal" : "DIFFERENT: not all", holds ? Tone::kGood : Tone::kBad, style),
      ToleranceText(comparison.tolerance));
}

std::string ComparisonLatex(const JobComparison& comparison) {
  const std::string parameters =
      comparison.parameters.empty() ? "" : Tabular(ParameterCells(comparison, "Parameter")) + "\n";
  return parameters + Tabular(ResultCells(comparison, 7, "Result", "Deviation"));
}

}  // namespace contact::cli
