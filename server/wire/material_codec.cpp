#include "wire/material_codec.h"

#include <fmt/format.h>

#include <cmath>

namespace contact {
namespace {

constexpr Range kYoungsModulus{0, 1e15, "(0, 1e15]"};
constexpr Range kPoissonRatio{-1, 0.5, "(-1, 0.5]"};

}  // namespace

void CheckMaterial(const v1::Material& material, std::string_view path, const Rules& rules) {
  const std::string modulus = fmt::format("{}.youngs_modulus_pa", path);
  const std::string ratio = fmt::format("{}.poisson_ratio", path);
  if (material.youngs_modulus_pa() == 0) {
    rules.Break(modulus, "is missing; must be in (0, 1e15]", "steel has 2.1e11");
  } else {
    rules.Require(modulus, material.youngs_modulus_pa(), kYoungsModulus);
  }
  if (!material.has_poisson_ratio()) {
    rules.Break(ratio, "is missing", "steel has 0.3");
  } else {
    rules.Require(ratio, material.poisson_ratio(), kPoissonRatio);
  }
}

double Compliance(const v1::Material& material) {
  const double ratio = material.poisson_ratio();
  return (1 - ratio) * (1 + ratio) / material.youngs_modulus_pa();
}

double HertzStiffness(double compliance, double curvature) {
  return 4.0 / 3 / (compliance * std::sqrt(curvature));
}

}  // namespace contact
