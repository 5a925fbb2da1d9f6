#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace contact::cli {

/// A field of a line of a table, and the place where it begins, from 1.
struct TableField {
  std::string text;
  int column = 1;
};

/// The fields of a line without space around them. ' ' separates by runs of spaces. A field in
/// quotes may have separators; "" in it is one quote.
std::vector<TableField> AllFieldsOf(std::string_view line, char separator);

/// The same without empty ones at the end.
std::vector<TableField> FieldsOf(std::string_view line, char separator);

/// Reads a field as a number: with a decimal comma or with a point. False for one that is none.
bool ReadField(std::string_view text, bool decimal_comma, double* number);

/// True for a field without a number: empty, nan or na.
bool IsGap(std::string_view text);

/// How the rows of a table are written.
struct TableDialect {
  char separator = ',';
  bool decimal_comma = false;
  /// For each field of a row: 'n' a number, 't' a text. Empty if there are no rows.
  std::string kinds = {};
  /// The first line that is a row.
  std::size_t first_row = 0;
};

/// Finds how a table is written by its lines from `first` on, by what most lines of its second half
/// have in common.
TableDialect FindDialect(std::span<const std::string_view> lines, std::size_t first);

/// The text of a file in UTF-8, without byte order mark: of UTF-16 by its mark, of UTF-8, or else
/// of Latin-1.
std::string InUtf8(const std::string& bytes);

}  // namespace contact::cli
