#pragma once

namespace contact {

/// Closed forms of an isolated collision: two bodies that meet at v = δ̇⁻ > 0 with the force
/// F = k δⁿ + μ δⁿ δ̇, and no other force. They depend on α = μ δ̇⁻/k alone, for any n, k and masses.
/// README.md of simulation/, equations (L1) to (L3).

/// The α [-] of an isolated collision that has the restitution ε, the root of            (L1)
///   α (1 + ε) = ln((1 + α)/(1 − α ε)).
/// For any ε > 0; it is 0 at ε = 1 and in (−1, 0) for ε > 1. Good to about 1e-15 relative.
double ExactCoefficient(double restitution);

/// The restitution ε [-], in (0, 1], of an isolated collision with α ≥ 0; inverts (L1):
///   ε = (1 + W₀(−(1 + α) e^{−(1 + α)}))/α.                                           (L2)
double DeliveredRestitution(double alpha);

/// Largest deformation δ_m [m] of an isolated collision:                                  (L3)
///   δ_m = [(n + 1)(m_e v²/k)(α − ln(1 + α))/α²]^{1/(n+1)}.
/// `effective_mass` [kg], `velocity` v [m/s] and `stiffness` k [N/mⁿ] are > 0, `exponent` n ≥ 1,
/// `alpha` ≥ 0 [-].
double MaximumDeformation(double effective_mass, double velocity, double stiffness, double exponent,
                          double alpha);

/// Elastic energy U [J] of a contact with the deformation δ [m], 0 for δ ≤ 0:             (W2)
///   U = ∫ k δⁿ dδ = k δⁿ⁺¹/(n + 1).
/// `stiffness` k [N/mⁿ], `exponent` n [-].
double ElasticEnergy(double stiffness, double exponent, double deformation);

/// The approach velocity v [m/s] of the isolated collision in which a contact has the deformation
/// δ [m], > 0, with the velocity δ̇ [m/s], of either sign:                                (L3a)
///   U(δ) = m_e (v/α)² [Loss(α) − Loss(α δ̇/v)],  Loss(x) = x − ln(1 + x).
/// With δ̇ = 0 it inverts MaximumDeformation.
double ApproachVelocity(double effective_mass, double deformation, double velocity,
                        double stiffness, double exponent, double alpha);

}  // namespace contact
