#include "cli/text/render_series.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "base/spelling.h"
#include "cli/base/csv.h"
#include "cli/base/number.h"
#include "cli/base/table.h"
#include "wire/column_bytes.h"
#include "wire/column_name.h"

namespace contact::cli {
namespace {

constexpr std::size_t kMostSamples = 40;

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
  std::string text = table.Text(style, kMostSamples, "… {} more samples; -o csv prints all");
  if (series.samples() == series.recorded_samples()) return text;
  return text + Wrap(fmt::format("{} of {}, no peak left out\n", series.samples(),
                                 Count(series.recorded_samples(), "sample", "samples")),
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

std::string SeriesJson(const v1::Series& series, const std::string& sampling) {
  using Json = nlohmann::ordered_json;
  Json columns = Json::array();
  for (const auto& column : series.columns()) {
    columns.push_back({{"name", column.name()},
                       {"quantity", column.quantity()},
                       {"unit", column.unit()},
                       {"values", Doubles(column.values())}});
  }
  Json document{{"name", series.name()},
                {"samples", series.samples()},
                {"recorded_samples", series.recorded_samples()}};
  if (!sampling.empty()) document["sampling"] = sampling;
  document["columns"] = std::move(columns);
  return document.dump() + "\n";  // NaN becomes null.
}

}  // namespace contact::cli
