#pragma once

#include <optional>
#include <string_view>

namespace contact::cli {

/// The factor that turns a number in `unit` into one in the SI unit `si`: 1e-3 for `mm/s` and
/// `m/s`. Knows s, min, h, m and N, their prefixes from n to G, and quotients. Nothing if `unit` is
/// unknown, or not of the kind of `si`.
std::optional<double> UnitFactor(std::string_view unit, std::string_view si);

}  // namespace contact::cli
