#pragma once

#include <string>
#include <vector>

namespace contact::cli {

/// One column of measured data.
struct MeasuredColumn {
  /// The header as it stands in the file.
  std::string header;
  /// The header without its unit.
  std::string name;
  /// The unit in brackets or parentheses at the end of the header; may be empty.
  std::string unit;
  /// One number a row; NaN where the file has none.
  std::vector<double> values = {};
};

/// Measured data as a file has it.
struct MeasuredTable {
  /// What messages call the file.
  std::string source;
  /// At least two, equally long.
  std::vector<MeasuredColumn> columns = {};

  /// The headers, for messages.
  std::string Headers() const;
};

/// True if `path` is a file that holds a table, not a JSON document.
bool IsTable(const std::string& path);

/// Splits `force [kN]` or `force (kN)` into name and unit. The unit is empty if there is none.
MeasuredColumn ColumnWithUnit(const std::string& header);

/// Reads a table: a header, then rows of numbers, with commas, semicolons or tabs between. Lines
/// that begin with # are comments. An empty field, or nan, is no number. Throws Failure: kLocal if
/// the file cannot be read, kInvalidScenario with all mistakes at their places.
MeasuredTable ReadTable(const std::string& path);

}  // namespace contact::cli
