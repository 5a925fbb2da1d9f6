#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace contact::cli {

/// Appends a number: `precision` significant digits, or with 0 as few as give the same double back.
/// NaN is `nan`, infinity `inf`. The form does not depend on the locale.
void AppendNumber(double value, int precision, std::string* text);

/// Appends rows of comma-separated values to a text, as RFC 4180 has them but with lines that end
/// in \n. A field with a comma, a quote or a line break stands in quotes.
class CsvWriter {
 public:
  /// `text` must outlive the writer; between rows the caller may take what stands in it. Numbers
  /// are written as AppendNumber does it with this precision.
  explicit CsvWriter(std::string* text, int precision = 0) : text_(text), precision_(precision) {}

  /// Adds a field of words to the row.
  CsvWriter& Add(std::string_view words);
  /// Adds a number to the row.
  CsvWriter& Add(double value);
  /// Ends the row.
  void EndRow();

  /// Writes a row of words only, such as the header.
  void Row(const std::vector<std::string>& words);

 private:
  /// Puts a comma before every field of a row but the first.
  void Separate();

  /// Receives the rows; not owned.
  std::string* const text_;
  const int precision_;
  /// True while a row has begun and not ended.
  bool row_has_fields_ = false;
};

}  // namespace contact::cli
