#include "cli/text/render_series.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "cli/base/csv.h"
#include "cli/base/number.h"
#include "cli/base/table.h"
#include "cli/link/columns.h"
#include "wire/column_name.h"

namespace contact::cli {
namespace {

constexpr std::size_t kMostRows = 40;

std::vector<std::vector<double>> Values(const v1::Series& series) {
  std::vector<std::vector<double>> columns;
  for (const auto& column : series.columns()) columns.push_back(Doubles(column.values()));
  return columns;
}

}  // namespace

std::string RenderSeries(const v1::Series& series, const Style& style) {
  std::vector<Table::Column> headers;
  for (const auto& column : series.columns()) {
    headers.push_back({ColumnHeader(column.name(), column.unit()), true});
  }
  Table table(std::move(headers));
  const std::vector<std::vector<double>> columns = Values(series);
  for (std::size_t row = 0; row < static_cast<std::size_t>(series.samples()); ++row) {
    std::vector<Table::Cell> cells;
    for (const auto& column : columns) cells.emplace_back(Digits(column.at(row), 7));
    table.Add(std::move(cells));
  }
  const std::string text = table.Text(style, kMostRows, "… {} more samples; -o csv prints all");
  if (series.samples() == series.recorded_samples()) return text;
  return text + Wrap(fmt::format("{} of {} samples, no peak left out\n", series.samples(),
                                 series.recorded_samples()),
                     style);
}

std::string SeriesCsv(const v1::Series& series) {
  std::string text;
  CsvWriter csv(&text);
  for (const auto& column : series.columns()) csv.Add(ColumnHeader(column.name(), column.unit()));
  csv.EndRow();
  const std::vector<std::vector<double>> columns = Values(series);
  for (std::size_t row = 0; row < static_cast<std::size_t>(series.samples()); ++row) {
    for (const auto& column : columns) csv.Add(column.at(row));
    csv.EndRow();
  }
  return text;
}

std::string SeriesJson(const v1::Series& series) {
  std::vector<std::string> columns;
  for (const auto& column : series.columns()) {
    columns.push_back(fmt::format(
        R"(  {{"name": "{}", "quantity": "{}", "unit": "{}", "values": [{}]}})", column.name(),
        column.quantity(), column.unit(), fmt::join(Doubles(column.values()), ", ")));
  }
  return fmt::format(
      "{{\"name\": \"{}\", \"samples\": {}, \"recorded_samples\": {}, \"columns\": [\n{}\n]}}\n",
      series.name(), series.samples(), series.recorded_samples(), fmt::join(columns, ",\n"));
}

}  // namespace contact::cli
