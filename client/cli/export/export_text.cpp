#include "cli/export/export_text.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace contact::cli {
namespace {

constexpr std::size_t kBlock = 1 << 16;

// How a text writes numbers.
struct Form {
  bool json = false;
  int precision = 0;
};

void Append(double value, const Form& form, fmt::memory_buffer* out) {
  if (form.json && !std::isfinite(value)) return out->append(std::string_view("null"));
  std::array<char, 32> digits{};  // The longest double has 24.
  char* const first = digits.data();
  char* const last = first + digits.size();
  const char* const end =
      form.precision == 0
          ? std::to_chars(first, last, value).ptr
          : std::to_chars(first, last, value, std::chars_format::general, form.precision).ptr;
  out->append(first, end);
}

// Names of bodies and contacts and values of enums need no quotes and no escapes: letters,
// digits, '_', '.' and '-'.
void Append(const DataColumn& column, std::size_t row, const Form& form, fmt::memory_buffer* out) {
  if (const auto* numbers = std::get_if<std::vector<double>>(&column.values)) {
    return Append((*numbers)[row], form, out);
  }
  const std::string_view quote = form.json ? "\"" : "";
  out->append(quote);
  out->append(std::get<std::vector<std::string>>(column.values)[row]);
  out->append(quote);
}

void Flush(fmt::memory_buffer* out, std::FILE* file, std::size_t least) {
  if (out->size() < least) return;
  std::fwrite(out->data(), 1, out->size(), file);
  out->clear();
}

}  // namespace

void WriteCsv(const DataTable& table, std::FILE* file, int precision) {
  const Form form{.json = false, .precision = precision};
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
      Append(column, row, form, &out);
      separator = ",";
    }
    out.push_back('\n');
    Flush(&out, file, kBlock);
  }
  Flush(&out, file, 0);
}

void WriteJsonLines(const DataTable& table, std::FILE* file, int precision) {
  const Form form{.json = true, .precision = precision};
  std::vector<std::string> keys;  // With what stands before them.
  for (const DataColumn& column : table.columns) {
    keys.push_back(fmt::format("{}\"{}\":", keys.empty() ? "{" : ",", column.Header()));
  }
  fmt::memory_buffer out;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    for (std::size_t i = 0; i < keys.size(); ++i) {
      out.append(keys[i]);
      Append(table.columns[i], row, form, &out);
    }
    out.append(std::string_view("}\n"));
    Flush(&out, file, kBlock);
  }
  Flush(&out, file, 0);
}

}  // namespace contact::cli
