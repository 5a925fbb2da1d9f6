#include "cli/base/unit.h"

#include <array>
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
constexpr std::array<Factor, 2> kTimes{{{"min", 60}, {"h", 3600}}};

// The factor of a unit without a quotient.
std::optional<double> SimpleFactor(std::string_view unit, std::string_view si) {
  if (unit == si) return 1;
  if (si == "s") {
    for (const auto& [name, factor] : kTimes) {
      if (unit == name) return factor;
    }
  }
  if (!unit.ends_with(si) || (si != "s" && si != "m" && si != "N")) return std::nullopt;
  unit.remove_suffix(si.size());
  for (const auto& [prefix, factor] : kPrefixes) {
    if (unit == prefix) return factor;
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> UnitFactor(std::string_view unit, std::string_view si) {
  const std::size_t slash = unit.find('/');
  const std::size_t si_slash = si.find('/');
  if ((slash == std::string_view::npos) != (si_slash == std::string_view::npos))
    return std::nullopt;
  const auto above = SimpleFactor(unit.substr(0, slash), si.substr(0, si_slash));
  if (slash == std::string_view::npos || !above) return above;
  const auto below = SimpleFactor(unit.substr(slash + 1), si.substr(si_slash + 1));
  return below ? std::optional(*above / *below) : std::nullopt;
}

}  // namespace contact::cli
