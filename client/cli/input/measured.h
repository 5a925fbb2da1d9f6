#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/input/diagnostic.h"

namespace contact::cli {

/// What a table says of one of its columns.
struct MeasuredColumn {
  /// The header as it stands in the file; empty if there is none.
  std::string header;
  /// The header without its unit.
  std::string name;
  /// The unit at the end of the header, or below it; may be empty.
  std::string unit;
};

/// A table of numbers as loggers and people write it: any lines, then headers, then perhaps a row
/// of units, then rows. Finds by itself what separates columns (tabs, semicolons, commas or runs of
/// spaces), decimal commas, quotes, where the rows begin, and UTF-16 by its byte order mark. Lines
/// that begin with # are comments; the last one before the rows may be the headers.
class MeasuredTable {
 public:
  /// Reads a file. `skip`: so many lines come before the headers; else they are found. Throws
  /// Failure: kLocal if the file cannot be read, kInvalidScenario if it has no rows.
  static MeasuredTable Open(const std::string& path, std::optional<int> skip = {});

  /// Reads the bytes of a file that messages call `source`. Throws InvalidFile.
  MeasuredTable(std::string source, const std::string& bytes, std::optional<int> skip = {});

  const std::string& source() const { return source_; }
  /// At least two.
  const std::vector<MeasuredColumn>& columns() const { return columns_; }
  std::size_t rows() const { return rows_.size(); }
  /// The headers, for messages; the number of a column without one.
  std::string Headers() const;
  /// The first column that is called time or t, or none.
  std::optional<std::size_t> TimeColumn() const;

  /// What a field is that is empty or nan.
  enum class Gap { kNaN, kMistake };
  /// The numbers of a column, one a row; NaN for a gap. Adds a mistake for each field that is no
  /// number and has none yet, until there are kMostMistakes.
  std::vector<double> Numbers(std::size_t column, Gap gap, std::vector<Diagnostic>* mistakes) const;

  /// A mistake in the field of a row and a column.
  Diagnostic At(std::size_t row, std::size_t column, std::string what, std::string hint) const;

  static constexpr std::size_t kMostMistakes = 20;

 private:
  // Reads a number; the mistake if there is none.
  std::optional<Diagnostic> ReadNumber(std::size_t row, std::size_t column, Gap gap,
                                       double* number) const;
  // Where headers and rows are, and what separates their fields.
  void FindRows(std::size_t first);
  void ReadHeaders(std::size_t first);
  // The lines before the rows that may be headers, the last one first, without #.
  std::vector<std::string> Above(std::size_t first) const;
  Diagnostic AtLine(std::size_t line, int column, std::string what, std::string hint) const;

  std::string source_;
  std::unique_ptr<const std::string> text_;  // In UTF-8; stays where it is when the table moves.
  std::vector<std::string_view> lines_;      // Of it, without their ends.
  std::vector<std::size_t> rows_;            // Lines that are rows.
  char separator_ = ',';
  bool decimal_comma_ = false;
  std::vector<MeasuredColumn> columns_;
};

/// True if `path` is a file that holds a table, not a JSON document.
bool IsTable(const std::string& path);

/// Splits `force [kN]` or `force (kN)` into name and unit. The unit is empty if there is none.
MeasuredColumn ColumnWithUnit(const std::string& header);

/// True for the names of a column of times: `time`, `t` and alike, in either case.
bool IsTimeName(const std::string& name);

}  // namespace contact::cli
