#include "simulation/laws/isolated_collision.h"

#include <boost/math/tools/roots.hpp>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "simulation/laws/power.h"

namespace contact {
namespace {

// Loss(x) = x − ln(1 + x), without cancellation for small x; > −1. (L1) reads
// Loss(α) = Loss(−αε): the energy that damping leaves to compression, from either side.
double Loss(double x) {
  if (std::abs(x) > 0.1) return x - std::log1p(x);
  double sum = 0, power = x * x;  // x²/2 − x³/3 + x⁴/4 − …
  for (int i = 2; i < 24; ++i, power *= -x) sum += power / i;
  return sum;
}

// q + e^{−q} − 1 = Loss(−w) with w = 1 − e^{−q}, without cancellation for small q; q ≥ 0.
double LossOfLog(double q) {
  if (q > 0.1) return q + std::expm1(-q);
  double sum = 0, term = q * q / 2;  // q²/2 − q³/6 + q⁴/24 − …
  for (int i = 3; i < 16; ++i, term *= -q / (i - 1)) sum += term;
  return sum;
}

}  // namespace

double ExactCoefficient(double restitution) {
  assert(restitution > 0);
  const double e = restitution;
  if (e == 1) return 0;
  if (e > 1) return -ExactCoefficient(1 / e) / e;  // The same collision, run backwards.
  // With q = −ln(1 − αε): Loss(α) = LossOfLog(q), α = (1 − e^{−q})/ε. In q the root is well
  // conditioned even where αε is 1 to all digits. Start: the paper's (23).
  const double start = 1.5 * (1 - e * e) / (e * e + std::pow(e, 0.87));
  double q = e > 0.3 ? -std::log1p(-start * e) : Loss(1 / e) + 1;
  for (int i = 0; i < 50; ++i) {
    const double w = -std::expm1(-q);
    const double alpha = w / e;
    const double f = LossOfLog(q) - Loss(alpha);
    const double slope = w - alpha / (1 + alpha) * (1 - w) / e;
    const double step = f / slope;
    q -= step;
    if (std::abs(step) <= 1e-8 * q) break;  // The next one would be the square of that.
  }
  return -std::expm1(-q) / e;
}

double DeliveredRestitution(double alpha) {
  assert(alpha >= 0);
  if (alpha == 0) return 1;
  // Newton for LossOfLog(q) = Loss(α) from the right of the root: convex, so it never overshoots.
  const double loss = Loss(alpha);
  double q = loss + std::sqrt(2 * loss);
  for (int i = 0; i < 50; ++i) {
    const double step = (LossOfLog(q) - loss) / -std::expm1(-q);
    q -= step;
    if (std::abs(step) <= 1e-15 * q) break;
  }
  return -std::expm1(-q) / alpha;
}

double MaximumDeformation(double effective_mass, double velocity, double stiffness, double exponent,
                          double alpha) {
  const double loss = alpha == 0 ? 0.5 : Loss(alpha) / (alpha * alpha);
  return std::pow((exponent + 1) * effective_mass * velocity * velocity / stiffness * loss,
                  1 / (exponent + 1));
}

double ApproachVelocity(double effective_mass, double deformation, double velocity,
                        double stiffness, double exponent, double alpha) {
  const double stored = ElasticEnergy(stiffness, exponent, deformation) / effective_mass;
  if (alpha == 0) return std::sqrt(2 * stored + velocity * velocity);
  const double square = alpha * alpha, at_turn = std::sqrt(stored * square / Loss(alpha));
  if (velocity == 0) return at_turn;
  const auto excess = [&](double v) {
    return v * v / square * (Loss(alpha) - Loss(alpha * velocity / v)) - stored;
  };
  // The approach velocity with which δ̇ is there at δ = 0 already, in which nothing is stored.
  const double least = velocity > 0 ? velocity : -velocity / DeliveredRestitution(alpha);
  double most = least + at_turn;
  while (excess(most) < 0) most *= 2;
  std::uintmax_t trials = 100;
  const auto bracket =
      boost::math::tools::toms748_solve(excess, least, most, -stored, excess(most),
                                        boost::math::tools::eps_tolerance<double>(52), trials);
  return (bracket.first + bracket.second) / 2;
}

double ElasticEnergy(double stiffness, double exponent, double deformation) {
  return stiffness * Power(deformation, exponent).value * deformation / (exponent + 1);
}

}  // namespace contact
