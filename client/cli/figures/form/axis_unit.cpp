#include "cli/figures/form/axis_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/algorithm/string/replace.hpp>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

namespace contact::cli {
namespace {

constexpr std::array<std::pair<int, std::string_view>, 9> kPrefixes{{{-12, "p"},
                                                                     {-9, "n"},
                                                                     {-6, "µ"},
                                                                     {-3, "m"},
                                                                     {0, ""},
                                                                     {3, "k"},
                                                                     {6, "M"},
                                                                     {9, "G"},
                                                                     {12, "T"}}};
constexpr std::array<std::string_view, 5> kSymbols{"s", "m", "N", "J", "Pa"};  // With prefixes.

// What stands before the unit of a label, with a space; all of it without a unit.
std::string Quantity(const std::string& label) { return label.substr(0, label.rfind('[')); }

AxisUnit Shown(const std::string& label, int exponent, const std::string& unit) {
  return {std::pow(10, exponent), fmt::format("{}[{}]", Quantity(label), unit)};
}

// True if a prefix before the unit is one of its first symbol, alone and not a power of it.
bool TakesPrefix(std::string_view unit) {
  const std::size_t end = std::min(unit.find_first_of("/^*"), unit.find("·"));
  const bool power = end != std::string_view::npos && unit[end] == '^';
  return !power && std::ranges::find(kSymbols, unit.substr(0, end)) != kSymbols.end();
}

// True if people say it: there are ms and µs, but no ks.
bool IsUsual(std::string_view unit, int exponent) { return exponent < 0 || !unit.starts_with("s"); }

std::string_view PrefixOf(int exponent) {
  const auto* const found =
      std::ranges::find(kPrefixes, exponent, [](const auto& prefix) { return prefix.first; });
  return found == kPrefixes.end() ? std::string_view() : found->second;
}

std::string WithPower(const std::string& unit, int exponent) {
  return unit == "1" ? fmt::format("10^{}", exponent) : fmt::format("10^{} {}", exponent, unit);
}

}  // namespace

std::string UnitOf(const std::string& label) {
  const std::size_t begin = label.rfind('[');
  if (begin == std::string::npos || !label.ends_with("]")) return "";
  return label.substr(begin + 1, label.size() - begin - 2);
}

AxisUnit ReadableUnit(const std::string& label, double largest) {
  const std::string unit = UnitOf(label);
  const bool plain = largest >= 0.1 && largest < 1000;
  if (unit.empty() || plain || !std::isfinite(largest) || largest <= 0) return {1, label};
  const int exponent = 3 * static_cast<int>(std::floor(std::log10(largest) / 3 + 1e-12));
  const std::string prefix(PrefixOf(exponent));
  if (!prefix.empty() && TakesPrefix(unit) && IsUsual(unit, exponent)) {
    return Shown(label, exponent, prefix + unit);
  }
  // Some hundredths or thousands need no power.
  return largest >= 0.01 && largest < 1e5 ? AxisUnit{1, label}
                                          : Shown(label, exponent, WithPower(unit, exponent));
}

std::optional<AxisUnit> NamedUnit(const std::string& label, std::string unit) {
  const std::string base = UnitOf(label);
  if (base.empty()) return std::nullopt;
  if (unit == base) return AxisUnit{1, label};
  if (!TakesPrefix(base)) return std::nullopt;
  if (unit == "u" + base) unit.replace(0, 1, "µ");
  boost::replace_first(unit, "μ", "µ");  // The Greek letter for the sign of the prefix.
  for (const auto& [exponent, prefix] : kPrefixes) {
    if (unit == std::string(prefix) + base) return Shown(label, exponent, unit);
  }
  return std::nullopt;
}

}  // namespace contact::cli
