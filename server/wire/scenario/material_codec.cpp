#include "wire/scenario/material_codec.h"

#include <cmath>

namespace contact {

void CheckMaterial(const v1::Material& material, const Rules& rules) {
  rules.Read(material, v1::Material::kYoungsModulusPaFieldNumber, "steel has 2.1e11");
  rules.Read(material, v1::Material::kPoissonRatioFieldNumber, "steel has 0.3");
}

double Compliance(const v1::Material& material) {
  const double ratio = material.poisson_ratio();
  return (1 - ratio) * (1 + ratio) / material.youngs_modulus_pa();
}

double HertzStiffness(double compliance, double curvature) {
  return 4.0 / 3 / (compliance * std::sqrt(curvature));
}

}  // namespace contact
