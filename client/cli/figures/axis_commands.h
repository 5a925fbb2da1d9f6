#pragma once

#include <string>
#include <vector>

#include "cli/figures/figure.h"
#include "cli/figures/form/axis_unit.h"

namespace contact::cli {

/// The units in which a panel shows its axes.
struct PanelUnits {
  AxisUnit x;
  AxisUnit y;
};

/// The units that suit the points of the curves. An axis has the first of `named` that is one of
/// its own; else the one that reads best, and a logarithmic one that of its label.
PanelUnits UnitsOf(const Figure::Panel& panel, const std::vector<std::string>& named = {});

/// Commands of gnuplot for scale, tics and range of both axes of a panel in these units. The ranges
/// hold all points of its curves but for those that have no place: NaN, and on a logarithmic axis
/// what is not above 0.
std::string AxisCommands(const Figure::Panel& panel, const PanelUnits& units = {});

}  // namespace contact::cli
