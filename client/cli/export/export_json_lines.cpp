#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/base/csv.h"
#include "cli/export/writers.h"

namespace contact::cli {
namespace {

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
