#pragma once

#include <optional>
#include <string>

namespace contact::cli {

/// The unit in which an axis shows its numbers.
struct AxisUnit {
  /// What the axis shows as 1, in the unit of the values; > 0.
  double size = 1;
  /// Quantity and unit, such as `time [ms]` or `work [10^-15 J]`.
  std::string label = {};
};

/// The unit of the values that a label of an axis names, such as `s` of `time [s]`; empty: none.
std::string UnitOf(const std::string& label);

/// The unit in which the numbers of an axis have few digits, all with the same power of ten:
/// that of the label with a prefix of SI, such as ms, or, if it takes none, a power of ten. It is
/// that of the label itself while `largest`, the largest of their absolute values, is from 0.1 to
/// 1000, or is no number. A label without a unit stays as it is.
AxisUnit ReadableUnit(const std::string& label, double largest);

/// The axis in the unit that a user names, such as `mm` or `µm`, which may be written um. None
/// unless it is the unit of the label, with a prefix of SI or without.
std::optional<AxisUnit> NamedUnit(const std::string& label, std::string unit);

}  // namespace contact::cli
