#include "cli/input/measured.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <filesystem>
#include <fstream>
#include <limits>
#include <utility>

#include "base/spelling.h"
#include "cli/base/files.h"
#include "cli/base/unit.h"
#include "cli/input/table_dialect.h"

namespace contact::cli {
namespace {

constexpr std::size_t kMostBytes = 512 << 20;

std::string WithoutBrackets(const std::string& text) {
  const bool bracketed = text.size() > 2 && ((text.front() == '[' && text.back() == ']') ||
                                             (text.front() == '(' && text.back() == ')'));
  return bracketed ? boost::trim_copy(text.substr(1, text.size() - 2)) : text;
}

// Headers, in which what stands in brackets belongs to what is before it.
std::vector<std::string> HeadersOf(const std::string& line, char separator) {
  std::vector<std::string> headers;
  for (const TableField& field : FieldsOf(line, separator)) {
    const bool unit = field.text.starts_with('[') || field.text.starts_with('(');
    if (separator == ' ' && unit && !headers.empty() && !IsUnit(WithoutBrackets(headers.back()))) {
      headers.back() += " " + field.text;
    } else {
      headers.push_back(field.text);
    }
  }
  return headers;
}

// Whether a row below the headers has units. Some of them may be of other quantities.
bool AreUnits(const std::vector<std::string>& fields) {
  return std::ranges::any_of(fields,
                             [](const auto& field) { return IsUnit(WithoutBrackets(field)); }) &&
         std::ranges::all_of(fields, [](const auto& field) { return field.size() < 16; });
}

}  // namespace

MeasuredTable MeasuredTable::Open(const std::string& path, std::optional<int> skip) {
  return {path, ReadText(path, kMostBytes), skip};
}

MeasuredTable::MeasuredTable(std::string source, const std::string& bytes, std::optional<int> skip)
    : source_(std::move(source)), text_(std::make_unique<const std::string>(InUtf8(bytes))) {
  for (std::size_t begin = 0; begin < text_->size();) {
    const std::size_t end = std::min(text_->find('\n', begin), text_->size());
    std::string_view line = std::string_view(*text_).substr(begin, end - begin);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines_.push_back(line);
    begin = end + 1;
  }
  FindRows(static_cast<std::size_t>(skip.value_or(0)));
}

void MeasuredTable::FindRows(std::size_t first) {
  const TableDialect dialect = FindDialect(lines_, first);
  if (dialect.kinds.empty()) {
    RequireNone({AtLine(0, 1, "has no rows of numbers in two columns or more",
                        "columns are separated by tabs, semicolons, commas or spaces")});
  }
  separator_ = dialect.separator;
  decimal_comma_ = dialect.decimal_comma;
  for (std::size_t i = dialect.first_row; i < lines_.size(); ++i) {
    const bool blank = lines_[i].find_first_not_of(" \t") == std::string_view::npos;
    if (!blank && !lines_[i].starts_with('#')) rows_.push_back(i);
  }
  columns_.resize(dialect.kinds.size());
  ReadHeaders(first);
}

std::vector<std::string> MeasuredTable::Above(std::size_t first) const {
  std::vector<std::string> above;
  for (std::size_t i = rows_.front(); i-- > first && above.size() < 2;) {
    std::string line(lines_[i]);
    const bool comment = line.starts_with('#');
    if (comment) line.erase(0, 1);
    boost::trim_if(line, boost::is_any_of(" "));
    if (line.empty() || (comment && HeadersOf(line, separator_).size() != columns_.size()))
      continue;
    above.push_back(line);
  }
  return above;
}

void MeasuredTable::ReadHeaders(std::size_t first) {
  const std::vector<std::string> above = Above(first);
  std::vector<std::string> headers, units;
  if (!above.empty()) headers = HeadersOf(above[0], separator_);
  if (above.size() == 2 && AreUnits(headers)) {
    std::vector<std::string> upper = HeadersOf(above[1], separator_);
    if (upper.size() >= headers.size() && upper.size() >= 2) {
      units = std::exchange(headers, std::move(upper));
    }
  }
  if (headers.size() < 2) return;  // A title, or nothing.
  if (headers.size() < columns_.size()) {
    RequireNone(
        {AtLine(rows_.front(), 1,
                fmt::format("has {} fields; the header has {}", columns_.size(), headers.size()),
                separator_ == ',' ? "decimals are written with a point where commas separate"
                                  : "headers, if there are any, stand right above the rows")});
  }
  columns_.resize(headers.size());
  for (std::size_t i = 0; i < headers.size(); ++i) {
    columns_[i] = ColumnWithUnit(headers[i]);
    if (i < units.size() && columns_[i].unit.empty()) columns_[i].unit = WithoutBrackets(units[i]);
  }
}

std::vector<double> MeasuredTable::Numbers(std::size_t column, Gap gap,
                                           std::vector<Diagnostic>* mistakes) const {
  std::vector<double> numbers(rows_.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t row = 0; row < rows_.size() && mistakes->size() < kMostMistakes; ++row) {
    std::optional<Diagnostic> mistake = ReadNumber(row, column, gap, &numbers[row]);
    const auto is_told = [&mistake](const Diagnostic& told) {
      return told.line == mistake->line && told.column == mistake->column;
    };
    if (mistake && std::ranges::none_of(*mistakes, is_told)) mistakes->push_back(*mistake);
  }
  return numbers;
}

std::optional<Diagnostic> MeasuredTable::ReadNumber(std::size_t row, std::size_t column, Gap gap,
                                                    double* number) const {
  const std::vector<TableField> fields = FieldsOf(lines_[rows_[row]], separator_);
  constexpr char kPoint[] = "decimals are written with a point";
  if (fields.size() > columns_.size()) {
    return AtLine(rows_[row], fields[columns_.size()].column,
                  fmt::format("has {} fields; others have {}", fields.size(), columns_.size()),
                  separator_ == ',' ? kPoint : "");
  }
  const std::string text = column < fields.size() ? fields[column].text : std::string();
  if (IsGap(text)) {
    if (gap == Gap::kNaN) return std::nullopt;
    return At(row, column, text.empty() ? "has no number" : fmt::format("is {}", text),
              "a table of a load or motion has no gaps");
  }
  if (ReadField(text, decimal_comma_, number)) return std::nullopt;
  const bool comma = text.find(',') != std::string::npos;
  return At(row, column, fmt::format("expected a number, got {}", Quoted(text)),
            decimal_comma_ ? "decimals are written with a comma here"
            : comma        ? kPoint
                           : "");
}

Diagnostic MeasuredTable::At(std::size_t row, std::size_t column, std::string what,
                             std::string hint) const {
  const std::vector<TableField> fields = FieldsOf(lines_[rows_[row]], separator_);
  const int end = static_cast<int>(lines_[rows_[row]].size()) + 1;
  return AtLine(rows_[row], column < fields.size() ? fields[column].column : end, std::move(what),
                std::move(hint));
}

Diagnostic MeasuredTable::AtLine(std::size_t line, int column, std::string what,
                                 std::string hint) const {
  return {.source = source_,
          .line = static_cast<int>(line) + 1,
          .column = column,
          .field = {},
          .what = std::move(what),
          .hint = std::move(hint)};
}

std::string MeasuredTable::Headers() const {
  std::vector<std::string> headers;
  for (const MeasuredColumn& column : columns_) {
    headers.push_back(column.header.empty() ? fmt::format("{}", headers.size() + 1)
                                            : column.header);
  }
  return fmt::format("{}", fmt::join(headers, ", "));
}

std::optional<std::size_t> MeasuredTable::TimeColumn() const {
  const auto found = std::ranges::find_if(
      columns_, [](const MeasuredColumn& column) { return IsTimeName(column.name); });
  if (found == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns_.begin());
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

bool IsTimeName(const std::string& name) {
  const std::string lower = boost::to_lower_copy(name);
  return lower == "time" || lower == "t" || lower == "zeit" || lower == "temps";
}

}  // namespace contact::cli
