#pragma once

#include <string>
#include <vector>

#include "cli/base/style.h"

namespace contact::cli {

/// Rows of text in columns as wide as their widest cell. Where a terminal is too narrow, headers go
/// over several lines; then columns are left out, unless they were asked for; and where not even
/// the others fit, each row is a block of all its cells, one below the other.
class Table {
 public:
  static constexpr int kOnlyWide = -1;
  struct Column {
    std::string header;
    bool right = false;  ///< Aligned to the right, as numbers are.
    /// > 0: left out on a narrow terminal, the highest first; kOnlyWide: shown in wide tables.
    int spare = 0;
    /// What --columns and CSV call it; empty: its header in small letters without its unit.
    std::string name = {};

    std::string Name() const;
  };
  struct Cell {
    Cell(std::string words, Tone its_tone = Tone::kPlain)  // NOLINT(google-explicit-constructor)
        : text(std::move(words)), tone(its_tone) {}
    std::string text;
    Tone tone;
  };

  /// Throws Failure (kUsage) unless each of `names` is the name or header of a column.
  static void RequireColumns(const std::vector<Column>& columns,
                             const std::vector<std::string>& names);

  explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}

  /// Adds a row; one cell a column.
  void Add(std::vector<Cell> row) { rows_.push_back(std::move(row)); }

  /// The table, with at most `most` rows (0: all): of more, the first and the last are shown and
  /// `more` stands between them, its {} being how many are not.
  std::string Text(const Style& style, std::size_t most = 0, const std::string& more = "") const;

  /// All rows as CSV below the names of the columns: of those named, or of all. A cell of `-` is
  /// empty.
  std::string Csv(const std::vector<std::string>& names = {}) const;

 private:
  struct Layout {
    std::vector<std::vector<std::string>> headers;  ///< Lines of each.
    std::vector<int> widths;
    std::vector<std::size_t> shown;

    int Total() const;
  };

  int WidestCell(std::size_t column) const;
  Layout Full(const Style& style) const;
  Layout Narrow(const Style& style) const;
  std::string Header(const Layout& layout, const Style& style) const;
  std::string Row(const Layout& layout, std::size_t row, const Style& style) const;
  std::string Block(const Layout& layout, std::size_t row, const Style& style) const;

  std::vector<Column> columns_;
  std::vector<std::vector<Cell>> rows_;
};

}  // namespace contact::cli
