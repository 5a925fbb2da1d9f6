#pragma once

#include <optional>

#include "translate/impact.h"

namespace contact::translate {

/// The damping c, in units of DampingUnit, with which an isolated collision gives back ε in (0, 1]
/// under a law like `law`, whose own k and c do not count. Its `full_depth` is in units of
/// LengthUnit. Nothing if no damping does.
std::optional<double> DampingFor(const ForceLaw& law, double restitution);

/// What textbooks give for the same, by the exponents of `law`, in the same units:
///   n = 1, p = 0: 2ξ; n = 1.5, p = ¼: √5 ξ (Antypov and Elliott 2011); p = n: 3(1 − ε)/2 (Hunt and
/// Crossley 1975); ξ = −ln ε/√(π² + ln² ε). Nothing for other exponents, and where s is not 1.
std::optional<double> TextbookDamping(const ForceLaw& law, double restitution);

/// ξ(ε) [-], in [0, 1); 0 at ε = 1.
double DampingRatio(double restitution);

/// The ε [-] whose DampingRatio is ξ ≥ 0; the inverse. NaN for ξ ≥ 1.
double RestitutionOfRatio(double ratio);

/// The c [N·s/m^1.25] = √5 ξ(e) √(k m_e) of the damper δ^¼ that several programs make from a
/// restitution e, and its inverse, NaN where no e has so large a c.
double QuarterPowerDamping(double stiffness, double mass, double restitution);
double QuarterPowerRestitution(double stiffness, double mass, double damping);

/// `law` with the k [N/mⁿ] for which the collision lasts `duration` [s]. Its c is in units of
/// DampingUnit before, and in N·s/mᵖ⁺¹ after; so are c and full_depth.
ForceLaw WithDuration(ForceLaw law, const Collision& collision, double duration);

/// `law` with this k [N/mⁿ]; c and full_depth as before, after.
ForceLaw WithStiffness(ForceLaw law, const Collision& collision, double stiffness);

}  // namespace contact::translate
