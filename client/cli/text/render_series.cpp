#include "cli/text/render_series.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <vector>

#include "cli/base/number.h"
#include "cli/base/table.h"

namespace contact::cli {
namespace {

static_assert(std::endian::native == std::endian::little, "columns are little-endian");

constexpr std::size_t kMostRows = 40;

std::vector<double> Values(const v1::FrameChunk::Column& column) {
  std::vector<double> values(column.values().size() / sizeof(double));
  std::memcpy(values.data(), column.values().data(), values.size() * sizeof(double));
  return values;
}

std::vector<std::vector<double>> Values(const v1::Series& series) {
  std::vector<std::vector<double>> columns;
  for (const auto& column : series.columns()) columns.push_back(Values(column));
  return columns;
}

// `m/s` as it stands in names: `m_per_s`.
std::string InName(const std::string& unit) {
  std::string text;
  for (const char c : unit) {
    if (c == '/') {
      text += "_per_";
    } else {
      text += c == 'N' ? 'n' : c;
    }
  }
  return text;
}

}  // namespace

std::string RenderSeries(const v1::Series& series, const Style& style) {
  std::vector<Table::Column> headers;
  for (const auto& column : series.columns()) {
    headers.push_back({fmt::format("{} [{}]", column.name(), column.unit()), true});
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
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  for (int i = 0; i < series.columns_size(); ++i) {
    const auto& column = series.columns(i);
    fmt::format_to(out, "{}{}_{}", i == 0 ? "" : ",", column.name(), InName(column.unit()));
  }
  fmt::format_to(out, "\n");
  const std::vector<std::vector<double>> columns = Values(series);
  for (std::size_t row = 0; row < static_cast<std::size_t>(series.samples()); ++row) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      fmt::format_to(out, "{}{}", i == 0 ? "" : ",", columns[i].at(row));
    }
    fmt::format_to(out, "\n");
  }
  return fmt::to_string(text);
}

std::string SeriesJson(const v1::Series& series) {
  std::vector<std::string> columns;
  for (const auto& column : series.columns()) {
    columns.push_back(fmt::format(
        R"(  {{"name": "{}", "quantity": "{}", "unit": "{}", "values": [{}]}})", column.name(),
        column.quantity(), column.unit(), fmt::join(Values(column), ", ")));
  }
  return fmt::format(
      "{{\"name\": \"{}\", \"samples\": {}, \"recorded_samples\": {}, \"columns\": [\n{}\n]}}\n",
      series.name(), series.samples(), series.recorded_samples(), fmt::join(columns, ",\n"));
}

}  // namespace contact::cli
