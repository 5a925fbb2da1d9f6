#pragma once

#include <cstdint>
#include <vector>

#include "contact/v1/scenario.pb.h"
#include "wire/scenario/scenario_codec.h"

namespace contact {

/// The cells of a sweep: the value of each axis for each number of a cell.
class SweepAxes {
 public:
  /// No cells.
  SweepAxes() = default;

  /// Lists or draws the values of all axes. Equal sweeps give equal values on every machine. Notes
  /// the rules that the axes break; if they break any, there are no cells. `max_cells`: limit of
  /// the server.
  SweepAxes(const v1::Sweep& sweep, std::int32_t max_cells, std::vector<Violation>* violations);

  /// Number of cells; 0 if the axes break a rule.
  std::int32_t cells() const { return cells_; }

  /// The value of each axis in the cell with this number, from 0 to cells() − 1.
  std::vector<double> Values(std::int32_t cell) const;

 private:
  // True if cells take every value of an axis with every value of the others.
  bool grid_ = false;
  // The values of each axis: in a grid those of the axis, else one for each cell.
  std::vector<std::vector<double>> values_;
  std::int32_t cells_ = 0;
};

}  // namespace contact
