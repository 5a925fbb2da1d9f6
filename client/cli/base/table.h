#pragma once

#include <string>
#include <vector>

#include "cli/base/style.h"

namespace contact::cli {

/// Rows of text in columns that are as wide as their widest cell. On a narrow terminal headers are
/// folded to several lines first. Then columns that can be spared are left out, unless they were
/// asked for. Where the remaining columns do not fit either, each row becomes a block with one cell
/// a line.
class Table {
 public:
  /// Value of Column::spare for a column that only wide tables have.
  static constexpr int kOnlyWide = -1;

  /// How a column is shown.
  struct Column {
    /// Text above the column, in brackets its unit if it has one: `t [s]`.
    std::string header;
    /// True if cells and header are aligned to the right, as numbers are.
    bool right = false;
    /// > 0: left out on a narrow terminal, the highest first; kOnlyWide: shown in wide tables.
    int spare = 0;
    /// What --columns and CSV call it; empty: its header in small letters without its unit.
    std::string name = {};

    /// `name`, or what is made of the header.
    std::string Name() const;
  };

  /// A text and its colour.
  struct Cell {
    Cell(std::string words, Tone its_tone = Tone::kPlain)  // NOLINT(google-explicit-constructor)
        : text(std::move(words)), tone(its_tone) {}
    /// In UTF-8, without a line break.
    std::string text;
    Tone tone;
  };

  /// Throws Failure (kUsage) unless each of `names` is the name or header of a column.
  static void RequireColumns(const std::vector<Column>& columns,
                             const std::vector<std::string>& names);

  /// A table without rows.
  explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}

  /// Adds a row; one cell a column. Characters that steer a terminal become spaces.
  void Add(std::vector<Cell> row);

  /// The table, with at most `most` rows (0: all): of more, the first and the last are shown and
  /// `more` stands between them, its {} being how many are not. One row more is shown instead.
  std::string Text(const Style& style, std::size_t most = 0, const std::string& more = "") const;

  /// All rows as CSV below the names of the columns: of those named, or of all. A cell of `-` is
  /// empty.
  std::string Csv(const std::vector<std::string>& names = {}) const;

 private:
  /// Which columns are shown and how wide they are, in characters.
  struct Layout {
    /// The lines of the header of each column.
    std::vector<std::vector<std::string>> headers;
    /// Width of each column.
    std::vector<int> widths;
    /// Indices of the columns that are shown, in their order.
    std::vector<std::size_t> shown;

    /// Width of a row, with the gaps between columns.
    int Total() const;
  };

  /// Width of the widest cell of a column, 0 without rows.
  int WidestCell(std::size_t column) const;
  /// The layout without a limit on width.
  Layout Full(const Style& style) const;
  /// The layout with folded headers and without the columns that must be spared.
  Layout Narrow(const Style& style) const;
  /// The headers, aligned at their last lines.
  std::string Header(const Layout& layout, const Style& style) const;
  /// A row as one line.
  std::string Row(const Layout& layout, std::size_t row, const Style& style) const;
  /// A row as a block: header and cell of each column in a line.
  std::string Block(const Layout& layout, std::size_t row, const Style& style) const;

  std::vector<Column> columns_;
  std::vector<std::vector<Cell>> rows_;
};

}  // namespace contact::cli
