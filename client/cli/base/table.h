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
  static constexpr int kOnlyWide = -1;  ///< For Column::spare.

  /// How a column is shown.
  struct Column {
    std::string header;  ///< May have a unit: `t [s]`.
    bool right = false;  ///< Aligned to the right, as numbers are.
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
    std::string text;
    Tone tone;
  };

  /// Throws Failure (kUsage) unless each of `names` is the name or header of a column.
  static void RequireColumns(const std::vector<Column>& columns,
                             const std::vector<std::string>& names);

  /// A table without rows.
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
  /// Which columns are shown and how wide they are, in characters.
  struct Layout {
    std::vector<std::vector<std::string>> headers;  ///< Lines of the header of each column.
    std::vector<int> widths;                        ///< Width of each column.
    std::vector<std::size_t> shown;                 ///< Indices of the columns shown, in order.

    /// Width of a row, with the gaps between columns.
    int Total() const;
  };

  int WidestCell(std::size_t column) const;
  /// The layout without a limit on width.
  Layout Full(const Style& style) const;
  /// The layout with folded headers and without the columns that must be spared.
  Layout Narrow(const Style& style) const;
  std::string Header(const Layout& layout, const Style& style) const;
  std::string Row(const Layout& layout, std::size_t row, const Style& style) const;
  /// A row as a block: header and cell of each column in a line.
  std::string Block(const Layout& layout, std::size_t row, const Style& style) const;

  std::vector<Column> columns_;
  std::vector<std::vector<Cell>> rows_;
};

}  // namespace contact::cli
