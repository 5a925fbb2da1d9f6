#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "cli/text/sweep/sweep_cells.h"

namespace contact::cli {

/// The cells of a sweep over two axes as a table. The values of the first axis are its rows, those
/// of the second its columns, both in the order in which the cells first have them.
class SweepGrid {
 public:
  /// True if the sweep combines exactly two axes as a grid.
  static bool IsGrid(const v1::Sweep& sweep);

  /// The table of a sweep; none unless it is a grid and has a cell. `cells` must outlive the table.
  static std::optional<SweepGrid> Of(const v1::Sweep& sweep, const SweepCells& cells);

  /// The values of the first axis.
  const std::vector<double>& rows() const { return rows_.values; }
  /// The values of the second axis.
  const std::vector<double>& columns() const { return columns_.values; }

  /// The row of a cell of this table.
  std::size_t RowOf(const v1::SweepCell& cell) const { return rows_.places.at(cell.values(0)); }
  /// The column of a cell of this table.
  std::size_t ColumnOf(const v1::SweepCell& cell) const {
    return columns_.places.at(cell.values(1));
  }
  /// The cell at a row and a column; null if it has not been computed yet.
  const v1::SweepCell* At(std::size_t row, std::size_t column) const {
    return cells_[row * columns_.values.size() + column];
  }

 private:
  /// The distinct values of an axis, and the place of each among them.
  struct Axis {
    /// Gathers the values that cells have on the axis with this index.
    Axis(const SweepCells& cells, int axis);
    std::vector<double> values;
    std::map<double, std::size_t> places;
  };

  /// `cells` are those of a grid over two axes; at least one.
  explicit SweepGrid(const SweepCells& cells);

  Axis rows_;
  Axis columns_;
  std::vector<const v1::SweepCell*> cells_;  // Row by row.
};

}  // namespace contact::cli
