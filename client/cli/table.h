#pragma once

#include <string>
#include <vector>

#include "cli/style.h"

namespace contact::cli {

/// Rows of text in columns as wide as their widest cell.
class Table {
 public:
  struct Column {
    std::string header;
    bool right = false;  ///< Aligned to the right, as numbers are.
    int spare = 0;       ///< > 0: left out on a narrow terminal, the highest first.
  };
  struct Cell {
    Cell(std::string words, Tone its_tone = Tone::kPlain)  // NOLINT(google-explicit-constructor)
        : text(std::move(words)), tone(its_tone) {}
    std::string text;
    Tone tone;
  };

  explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}

  /// Adds a row; one cell a column.
  void Add(std::vector<Cell> row) { rows_.push_back(std::move(row)); }

  /// The table, with at most `most` rows (0: all): of more, the first and the last are shown and
  /// `more` stands between them, its {} being how many are not.
  std::string Text(const Style& style, std::size_t most = 0, const std::string& more = "") const;

 private:
  std::vector<std::size_t> ShownColumns(const std::vector<int>& widths, const Style& style) const;

  std::vector<Column> columns_;
  std::vector<std::vector<Cell>> rows_;
};

}  // namespace contact::cli
