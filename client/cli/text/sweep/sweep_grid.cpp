#include "cli/text/sweep/sweep_grid.h"

namespace contact::cli {

SweepGrid::Axis::Axis(const SweepCells& cells, int axis) {
  for (const auto& [index, cell] : cells) {
    const double value = cell.values(axis);
    if (places.try_emplace(value, values.size()).second) values.push_back(value);
  }
}

bool SweepGrid::IsGrid(const v1::Sweep& sweep) {
  const bool grid = sweep.combination() == v1::Sweep::GRID ||
                    sweep.combination() == v1::Sweep::COMBINATION_UNSPECIFIED;
  return grid && sweep.axes_size() == 2;
}

std::optional<SweepGrid> SweepGrid::Of(const v1::Sweep& sweep, const SweepCells& cells) {
  if (!IsGrid(sweep) || cells.empty()) return std::nullopt;
  return SweepGrid(cells);
}

SweepGrid::SweepGrid(const SweepCells& cells)
    : rows_(cells, 0), columns_(cells, 1), cells_(rows().size() * columns().size()) {
  for (const auto& [index, cell] : cells) {
    cells_[RowOf(cell) * columns().size() + ColumnOf(cell)] = &cell;
  }
}

}  // namespace contact::cli
