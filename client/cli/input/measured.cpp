#include "cli/input/measured.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/algorithm/string/trim.hpp>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "base/spelling.h"
#include "cli/base/scalar.h"
#include "cli/base/text_file.h"
#include "cli/input/diagnostic.h"

namespace contact::cli {
namespace {

constexpr char kByteOrderMark[] = "\xEF\xBB\xBF";
constexpr std::size_t kMostMistakes = 20;

// A field of a line and the place where it begins, from 1.
struct Field {
  std::string text;
  int column = 1;
};

// The fields of a line. A field in quotes may have separators; "" in it is one quote.
std::vector<Field> FieldsOf(const std::string& line, char separator) {
  std::vector<Field> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back().text += line[i++];
    } else if (line[i] == '"') {
      quoted = !quoted;
    } else if (line[i] == separator && !quoted) {
      fields.push_back({"", static_cast<int>(i) + 2});
    } else {
      fields.back().text += line[i];
    }
  }
  for (Field& field : fields) boost::trim(field.text);
  return fields;
}

// The separator that the header has most often.
char SeparatorOf(const std::string& header) {
  return *std::ranges::max_element(std::string_view(",;\t"), {},
                                   [&header](char c) { return std::ranges::count(header, c); });
}

class TableReader {
 public:
  explicit TableReader(std::string source) : table_{std::move(source)} {}

  MeasuredTable Read(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) {
      ++line_;
      if (boost::trim_copy(line).empty() || line.starts_with('#')) continue;
      table_.columns.empty() ? ReadHeader(line) : ReadRow(line);
      if (mistakes_.size() >= kMostMistakes) break;
    }
    if (table_.columns.empty() || table_.columns.front().values.empty()) {
      Add(1, "has no rows", "a header and rows of numbers are expected");
    }
    RequireNone(mistakes_);
    return std::move(table_);
  }

 private:
  void ReadHeader(const std::string& line) {
    separator_ = SeparatorOf(line);
    for (const Field& field : FieldsOf(line, separator_)) {
      table_.columns.push_back(ColumnWithUnit(field.text));
    }
    if (table_.columns.size() == 1) {
      Add(1, "has one column", "columns are separated by commas, semicolons or tabs");
    }
  }

  void ReadRow(const std::string& line) {
    const std::vector<Field> fields = FieldsOf(line, separator_);
    if (fields.size() > table_.columns.size()) {
      return Add(fields[table_.columns.size()].column,
                 fmt::format("has {}; the header has {}",
                             Count(static_cast<std::int64_t>(fields.size()), "field", "fields"),
                             table_.columns.size()),
                 separator_ == ',' ? "decimals are written with a point" : "");
    }
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      const Field field = i < fields.size() ? fields[i] : Field{};
      table_.columns[i].values.push_back(Number(field));
    }
  }

  double Number(const Field& field) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    if (field.text.empty()) return kNone;
    if (const std::optional<double> number = ParseNumber(field.text)) return *number;
    const bool comma = field.text.find(',') != std::string::npos;
    Add(field.column, fmt::format("expected a number, got {}", Quoted(field.text)),
        comma ? "decimals are written with a point" : "");
    return kNone;
  }

  void Add(int column, std::string what, std::string hint) {
    mistakes_.push_back({.source = table_.source,
                         .line = std::max(line_, 1),
                         .column = column,
                         .field = {},
                         .what = std::move(what),
                         .hint = std::move(hint)});
  }

  MeasuredTable table_;
  char separator_ = ',';
  int line_ = 0;
  std::vector<Diagnostic> mistakes_;
};

}  // namespace

std::string MeasuredTable::Headers() const {
  std::vector<std::string> headers;
  for (const MeasuredColumn& column : columns) headers.push_back(column.header);
  return fmt::format("{}", fmt::join(headers, ", "));
}

bool IsTable(const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) return false;
  std::ifstream file(path);
  char first = '{';
  file >> first;  // Without the space before it.
  return first != '{';
}

MeasuredColumn ColumnWithUnit(const std::string& header) {
  MeasuredColumn column{header, boost::trim_copy(header), ""};
  const std::string& text = column.name;
  const bool brackets = text.ends_with(']');
  const std::size_t open = text.rfind(brackets ? '[' : '(');
  if ((!brackets && !text.ends_with(')')) || open == std::string::npos || open == 0) return column;
  column.unit = boost::trim_copy(text.substr(open + 1, text.size() - open - 2));
  column.name = boost::trim_copy(text.substr(0, open));
  return column;
}

MeasuredTable ReadTable(const std::string& path) {
  std::string text = ReadText(path);
  if (text.starts_with(kByteOrderMark)) text.erase(0, sizeof(kByteOrderMark) - 1);
  return TableReader(path).Read(LinesOf(text));
}

}  // namespace contact::cli
