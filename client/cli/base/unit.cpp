#include "cli/base/unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/algorithm/string/replace.hpp>
#include <cmath>
#include <utility>

namespace contact::cli {
namespace {

using Factor = std::pair<std::string_view, double>;

constexpr std::array<Factor, 9> kPrefixes{{{"n", 1e-9},
                                           {"u", 1e-6},
                                           {"µ", 1e-6},  // The micro sign,
                                           {"μ", 1e-6},  // and the letter.
                                           {"m", 1e-3},
                                           {"c", 1e-2},
                                           {"k", 1e3},
                                           {"M", 1e6},
                                           {"G", 1e9}}};

// A unit beside the SI unit and its prefixes, by the SI unit. All are exact by definition.
struct Other {
  std::string_view si, unit;
  double factor;
};
constexpr double kGravity = 9.80665, kFoot = 0.3048;
constexpr std::array<Other, 13> kOthers{{{"s", "min", 60},
                                         {"s", "h", 3600},
                                         {"m", "in", 0.0254},
                                         {"m", "ft", kFoot},
                                         {"N", "kgf", kGravity},
                                         {"N", "kp", kGravity},
                                         {"N", "lbf", 4.4482216152605},
                                         {"m/s", "mph", 0.44704},
                                         {"m/s", "kph", 1 / 3.6},
                                         {"m/s^2", "g", kGravity},
                                         {"m/s^2", "gn", kGravity},
                                         {"m/s^2", "mg", kGravity / 1000},
                                         {"m/s^2", "G", kGravity}}};

// What messages say, by the SI unit.
constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kUsual{
    {{"s", "s, ms, us, min, h"},
     {"m", "m, mm, cm, um, in, ft"},
     {"m/s", "m/s, mm/s, km/h, mph, ft/s"},
     {"m/s^2", "m/s^2, mm/s^2, g, ft/s^2"},
     {"N", "N, kN, mN, MN, kgf, lbf"}}};

// `m/s²` and `m/s2` as `m/s^2`.
std::string WithPower(std::string_view unit) {
  std::string text(unit);
  boost::replace_all(text, "²", "^2");
  boost::replace_all(text, "**2", "^2");
  if (text.ends_with("/s2")) text.insert(text.size() - 1, "^");
  return text;
}

// The factor of a unit without a quotient.
std::optional<double> SimpleFactor(std::string_view unit, std::string_view si) {
  if (unit == si) return 1;
  for (const Other& other : kOthers) {
    if (other.si == si && other.unit == unit) return other.factor;
  }
  if (!unit.ends_with(si) || (si != "s" && si != "m" && si != "N")) return std::nullopt;
  unit.remove_suffix(si.size());
  for (const auto& [prefix, factor] : kPrefixes) {
    if (unit == prefix) return factor;
  }
  return std::nullopt;
}

// The factor of what stands below a quotient, which may be a square.
std::optional<double> FactorBelow(std::string_view unit, std::string_view si) {
  constexpr std::string_view kSquare = "^2";
  if (unit.ends_with(kSquare) != si.ends_with(kSquare)) return std::nullopt;
  if (!unit.ends_with(kSquare)) return SimpleFactor(unit, si);
  unit.remove_suffix(kSquare.size()), si.remove_suffix(kSquare.size());
  const auto root = SimpleFactor(unit, si);
  return root ? std::optional(*root * *root) : std::nullopt;
}

}  // namespace

std::optional<double> UnitFactor(std::string_view unit, std::string_view si) {
  const std::string of = WithPower(unit), to = WithPower(si);
  if (const auto known = SimpleFactor(of, to)) return known;
  const std::size_t slash = of.find('/');
  const std::size_t si_slash = to.find('/');
  if (slash == std::string::npos || si_slash == std::string::npos) return std::nullopt;
  const std::string_view whole = of, whole_si = to;
  const auto above = SimpleFactor(whole.substr(0, slash), whole_si.substr(0, si_slash));
  const auto below = FactorBelow(whole.substr(slash + 1), whole_si.substr(si_slash + 1));
  return above && below ? std::optional(*above / *below) : std::nullopt;
}

double InSi(double value, double factor) {
  const double inverse = 1 / factor;
  return inverse == std::round(inverse) ? value / inverse : value * factor;
}

std::string UsualUnits(std::string_view si) {
  const auto* known = std::ranges::find(kUsual, WithPower(si),
                                        &std::pair<std::string_view, std::string_view>::first);
  return std::string(known == kUsual.end() ? si : known->second);
}

bool IsUnit(std::string_view text) {
  return std::ranges::any_of(
      kUsual, [text](const auto& usual) { return UnitFactor(text, usual.first).has_value(); });
}

}  // namespace contact::cli
