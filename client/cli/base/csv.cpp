#include "cli/base/csv.h"

#include <array>
#include <charconv>

namespace contact::cli {

void AppendNumber(double value, int precision, std::string* text) {
  std::array<char, 32> digits{};  // The longest double has 24.
  char* const first = digits.data();
  char* const last = first + digits.size();
  char* const end =
      precision == 0 ? std::to_chars(first, last, value).ptr
                     : std::to_chars(first, last, value, std::chars_format::general, precision).ptr;
  text->append(first, end);
}

CsvWriter& CsvWriter::Add(std::string_view words) {
  Separate();
  if (words.find_first_of(",\"\n\r") == std::string_view::npos) {
    text_->append(words);
    return *this;
  }
  *text_ += '"';
  for (const char c : words) text_->append(c == '"' ? 2 : 1, c);
  *text_ += '"';
  return *this;
}

CsvWriter& CsvWriter::Add(double value) {
  Separate();
  AppendNumber(value, precision_, text_);
  return *this;
}

void CsvWriter::EndRow() {
  *text_ += '\n';
  row_has_fields_ = false;
}

void CsvWriter::Row(const std::vector<std::string>& words) {
  for (const std::string& field : words) Add(field);
  EndRow();
}

void CsvWriter::Separate() {
  if (row_has_fields_) *text_ += ',';
  row_has_fields_ = true;
}

}  // namespace contact::cli
