#include "translate/damping.h"

#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace contact::translate {
namespace {

double Delivered(ForceLaw law, double damping) {
  law.stiffness = 1;
  law.damping = damping;
  return Collide(law, {}).velocity_ratio;
}

}  // namespace

std::optional<double> DampingFor(const ForceLaw& law, double restitution) {
  if (restitution == 1) return 0;
  const auto miss = [&](double damping) { return Delivered(law, damping) - restitution; };
  double high = 0.1;
  while (miss(high) > 0) {
    high *= 4;
    if (high > 1e5) return std::nullopt;
  }
  std::uintmax_t trials = 60;
  const auto [low, above] =
      boost::math::tools::toms748_solve(miss, 0.0, high, 1 - restitution, miss(high),
                                        boost::math::tools::eps_tolerance<double>(36), trials);
  return (low + above) / 2;
}

std::optional<double> TextbookDamping(const ForceLaw& law, double restitution) {
  if (law.full_depth > 0) return std::nullopt;
  if (law.damping_exponent == law.exponent) return 1.5 * (1 - restitution);
  if (law.exponent == 1 && law.damping_exponent == 0) return 2 * DampingRatio(restitution);
  if (law.exponent == 1.5 && law.damping_exponent == 0.25) {
    return std::sqrt(5.0) * DampingRatio(restitution);
  }
  return std::nullopt;
}

double DampingRatio(double restitution) {
  const double log = std::log(restitution);
  return -log / std::hypot(std::numbers::pi, log);
}

double RestitutionOfRatio(double ratio) {
  if (ratio >= 1) return std::numeric_limits<double>::quiet_NaN();
  return std::exp(-std::numbers::pi * ratio / std::sqrt(1 - ratio * ratio));
}

double QuarterPowerDamping(double stiffness, double mass, double restitution) {
  return DampingRatio(restitution) * std::sqrt(5 * stiffness * mass);
}

double QuarterPowerRestitution(double stiffness, double mass, double damping) {
  return RestitutionOfRatio(damping / std::sqrt(5 * stiffness * mass));
}

ForceLaw WithStiffness(ForceLaw law, const Collision& collision, double stiffness) {
  law.stiffness = stiffness;
  law.damping *= DampingUnit(law, collision);
  law.full_depth *= LengthUnit(law, collision);
  return law;
}

ForceLaw WithDuration(ForceLaw law, const Collision& collision, double duration) {
  law.stiffness = 1;
  const double length = duration * collision.velocity / Collide(law, {}).duration;
  return WithStiffness(law, collision,
                       collision.mass * collision.velocity * collision.velocity /
                           std::pow(length, law.exponent + 1));
}

}  // namespace contact::translate
