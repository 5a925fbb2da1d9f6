#include "cli/export/writers.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/base/csv.h"

namespace contact::cli {
namespace {

void AddCell(const DataColumn& column, std::size_t row, CsvWriter* csv) {
  if (const auto* numbers = std::get_if<std::vector<double>>(&column.values)) {
    csv->Add((*numbers)[row]);
  } else {
    csv->Add(std::get<std::vector<std::string>>(column.values)[row]);
  }
}

std::string Quoted(const std::string& text) { return nlohmann::json(text).dump(); }

void AppendValue(const DataColumn& column, std::size_t row, int precision, std::string* text) {
  const auto* numbers = std::get_if<std::vector<double>>(&column.values);
  if (numbers == nullptr) {
    *text += Quoted(std::get<std::vector<std::string>>(column.values)[row]);
  } else if (std::isfinite((*numbers)[row])) {
    AppendNumber((*numbers)[row], precision, text);
  } else {
    *text += "null";
  }
}

}  // namespace

TableWriter* TableWriterOf(OutputFormat format) {
  switch (format) {
#define TABLE_WRITER(enumerator, function) \
  case OutputFormat::enumerator:           \
    return function;
#include "cli/settings/formats.def"
    default:
      return nullptr;
  }
}

FileWriter* FileWriterOf(OutputFormat format) {
  switch (format) {
#define FILE_WRITER(enumerator, function) \
  case OutputFormat::enumerator:          \
    return function;
#include "cli/settings/formats.def"
    default:
      return nullptr;
  }
}

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

// An object a line and row. Keys are the headers of the columns; NaN and infinity, which JSON
// lacks, are null.
void WriteJsonLines(const DataTable& table, std::FILE* file, int precision) {
  std::vector<std::string> keys;  // Each with the punctuation around it.
  for (const DataColumn& column : table.columns) {
    keys.push_back((keys.empty() ? "{" : ",") + Quoted(column.Header()) + ":");
  }
  std::string text;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    for (std::size_t i = 0; i < keys.size(); ++i) {
      text += keys[i];
      AppendValue(table.columns[i], row, precision, &text);
    }
    text += "}\n";
    std::fwrite(text.data(), 1, text.size(), file);
    text.clear();
  }
}

}  // namespace contact::cli
