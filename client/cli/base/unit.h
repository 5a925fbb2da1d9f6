#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace contact::cli {

/// The factor that turns a number in `unit` into one in the SI unit `si`: 1e-3 for `mm/s` and
/// `m/s`. Knows s, min and h; m, in and ft; N, kgf and lbf; their quotients, also by s^2 (or s²,
/// s2); prefixes of s, m and N from n to G; mph; and g or gn, the standard acceleration 9.80665
/// m/s². Nothing if `unit` is unknown, or not of the kind of `si`.
std::optional<double> UnitFactor(std::string_view unit, std::string_view si);

/// A number in a unit with this factor as one in the SI unit. Divides where the factor is 1e-3 or
/// alike, so that 69 ms are the same number as 0.069 s.
double InSi(double value, double factor);

/// The units that people know of the quantity with this SI unit, for messages: `s, ms, us, min, h`.
std::string UsualUnits(std::string_view si);

/// True for a text that is a unit of some quantity of loads and motions.
bool IsUnit(std::string_view text);

}  // namespace contact::cli
