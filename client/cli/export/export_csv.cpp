#include "cli/export/export_csv.h"

#include <string>
#include <vector>

#include "cli/base/csv.h"

namespace contact::cli {
namespace {

constexpr std::size_t kBlock = 1 << 16;

void AddCell(const DataColumn& column, std::size_t row, CsvWriter* csv) {
  if (const auto* numbers = std::get_if<std::vector<double>>(&column.values)) {
    csv->Add((*numbers)[row]);
  } else {
    csv->Add(std::get<std::vector<std::string>>(column.values)[row]);
  }
}

}  // namespace

void WriteCsv(const DataTable& table, std::FILE* file, int precision) {
  std::string text;
  CsvWriter csv(&text, precision);
  for (const DataColumn& column : table.columns) csv.Add(column.Header());
  csv.EndRow();
  for (std::size_t row = 0; row < table.rows(); ++row) {
    for (const DataColumn& column : table.columns) AddCell(column, row, &csv);
    csv.EndRow();
    if (text.size() < kBlock) continue;
    std::fwrite(text.data(), 1, text.size(), file);
    text.clear();
  }
  std::fwrite(text.data(), 1, text.size(), file);
}

}  // namespace contact::cli
