#include "cli/export_text.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <string_view>

namespace contact::cli {
namespace {

constexpr std::size_t kBlock = 1 << 16;

// Names of bodies and contacts and values of enums need no quotes and no escapes: letters,
// digits, '_', '.' and '-'.
void Append(const DataColumn& column, std::size_t row, bool json, fmt::memory_buffer* out) {
  if (const auto* words = std::get_if<std::vector<std::string>>(&column.values)) {
    const std::string_view quote = json ? "\"" : "";
    fmt::format_to(std::back_inserter(*out), "{0}{1}{0}", quote, (*words)[row]);
    return;
  }
  const double value = std::get<std::vector<double>>(column.values)[row];
  if (std::isfinite(value) || !json) {
    fmt::format_to(std::back_inserter(*out), "{}", value);
  } else {
    out->append(std::string_view("null"));
  }
}

void Flush(fmt::memory_buffer* out, std::FILE* file, std::size_t least) {
  if (out->size() < least) return;
  std::fwrite(out->data(), 1, out->size(), file);
  out->clear();
}

}  // namespace

void WriteCsv(const DataTable& table, std::FILE* file) {
  fmt::memory_buffer out;
  std::string_view separator;
  for (const DataColumn& column : table.columns) {
    fmt::format_to(std::back_inserter(out), "{}{}", separator, column.Header());
    separator = ",";
  }
  out.push_back('\n');
  for (std::size_t row = 0; row < table.rows(); ++row) {
    separator = "";
    for (const DataColumn& column : table.columns) {
      out.append(separator);
      Append(column, row, false, &out);
      separator = ",";
    }
    out.push_back('\n');
    Flush(&out, file, kBlock);
  }
  Flush(&out, file, 0);
}

void WriteJsonLines(const DataTable& table, std::FILE* file) {
  fmt::memory_buffer out;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    std::string_view separator = "{";
    for (const DataColumn& column : table.columns) {
      fmt::format_to(std::back_inserter(out), "{}\"{}\":", separator, column.Header());
      Append(column, row, true, &out);
      separator = ",";
    }
    out.append(std::string_view("}\n"));
    Flush(&out, file, kBlock);
  }
  Flush(&out, file, 0);
}

}  // namespace contact::cli
