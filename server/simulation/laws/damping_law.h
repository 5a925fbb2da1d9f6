#pragma once

#include <string_view>

namespace contact {

/// How the damping factor μ of a cycle, in F = k δⁿ + μ δᵖ δ̇, is found. Those from kExact to
/// kGharibHurmuzlu are closed forms α(ε) with p = n and μ = α k / δ̇⁻; kKelvinVoigt and
/// kHertzQuarterPower need no δ̇⁻. README.md lists formula and source of each.
enum class DampingLaw {
  kEnergyRestitution,  ///< μ is iterated until ε_out = ε_in.
  kExact,
  kPaperEq23,
  kHuntCrossley,
  kLankaraniNikravesh,
  kFlores,
  kHuGuo,
  kLeeWang,
  kHerbertMcWhannell,
  kZhiyingQishao,
  kGonthier,
  kCarvalhoMartins,
  kGharibHurmuzlu,
  kKelvinVoigt,        ///< n = 1, p = 0.
  kHertzQuarterPower,  ///< n = 1.5, p = ¼.
  kGiven,              ///< μ is a number of the scenario.
};

/// Whether μ follows from ε, k and m_e alone: kKelvinVoigt and kHertzQuarterPower.
bool NeedsNoVelocity(DampingLaw law);

/// p of the law for the exponent n.
double DampingExponent(DampingLaw law, double exponent);

/// μ of a law that needs no velocity [N·s/mᵖ⁺¹], for ε in (0, 1]; (L7), (L8).
double DampingFactor(DampingLaw law, double restitution, double stiffness, double effective_mass);

/// α(ε) of a law [-], for ε in (0, 1]. For kEnergyRestitution and kExact: (L1).
/// Not for kGiven and laws that need no velocity, which have no α.
double DampingCoefficient(DampingLaw law, double restitution);

/// The α of an isolated collision that has the restitution ε, the root of            (L1)
///   α (1 + ε) = ln((1 + α)/(1 − α ε)).
/// For any ε > 0; it is 0 at ε = 1 and negative, above −1, for ε > 1. Any n, k, m, δ̇⁻.
double ExactCoefficient(double restitution);

/// The restitution that α delivers in an isolated collision, in (0, 1]: the inverse of (L1),
///   ε = (1 + W₀(−(1 + α) e^{−(1 + α)}))/α, for α ≥ 0.                                (L2)
double DeliveredRestitution(double alpha);

/// Largest deformation of an isolated collision [m]:                                  (L3)
///   δ_m = [(n + 1)(m_e v²/k)(α − ln(1 + α))/α²]^{1/(n+1)}.
double MaximumDeformation(double effective_mass, double velocity, double stiffness, double exponent,
                          double alpha);

}  // namespace contact
