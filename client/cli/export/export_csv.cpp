#include <string>
#include <vector>

#include "cli/base/csv.h"
#include "cli/export/writers.h"

namespace contact::cli {
namespace {

void AddCell(const DataColumn& column, std::size_t row, CsvWriter* csv) {
  if (const auto* numbers = std::get_if<std::vector<double>>(&column.values)) {
    csv->Add((*numbers)[row]);
  } else {
    csv->Add(std::get<std::vector<std::string>>(column.values)[row]);
  }
}

}  // namespace

// A line with the headers of the columns, then a line a row; NaN is `nan`.
void WriteCsv(const DataTable& table, std::FILE* file, int precision) {
  std::string text;
  CsvWriter csv(&text, precision);
  const auto end_row = [&] {
    csv.EndRow();
    std::fwrite(text.data(), 1, text.size(), file);
    text.clear();
  };
  for (const DataColumn& column : table.columns) csv.Add(column.Header());
  end_row();
  for (std::size_t row = 0; row < table.rows(); ++row) {
    for (const DataColumn& column : table.columns) AddCell(column, row, &csv);
    end_row();
  }
}

}  // namespace contact::cli
