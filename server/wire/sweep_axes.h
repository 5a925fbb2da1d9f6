#pragma once

#include <cstdint>
#include <vector>

#include "contact/v1/scenario.pb.h"
#include "wire/scenario_codec.h"

namespace contact {

/// The cells that the axes of a sweep make: a value of each axis for each number.
class SweepAxes {
 public:
  SweepAxes() = default;
  /// Notes the broken rules. If there are any, there are no cells.
  SweepAxes(const v1::Sweep& sweep, std::int32_t max_cells, std::vector<Violation>* violations);

  std::int32_t cells() const { return cells_; }
  /// Of a cell from 0 to cells() − 1: the value of each axis.
  std::vector<double> Values(std::int32_t cell) const;

 private:
  bool grid_ = false;
  std::vector<std::vector<double>>
      values_;  ///< Of each axis; for a grid its own, else each cell's.
  std::int32_t cells_ = 0;
};

}  // namespace contact
