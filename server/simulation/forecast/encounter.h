#pragma once

#include <optional>
#include <vector>

#include "simulation/model/scenario.h"

namespace contact {

/// How the two sides of a contact will first meet, as far as the scenario tells without solving it:
/// from velocities, gaps, supports to the ground and loads, but not from what other contacts do.
struct Encounter {
  double start = 0;     ///< When [s].
  double speed = 0;     ///< Of the impact [m/s]; 0: they touch at rest, and a load presses them.
  double duration = 0;  ///< Of a cycle: of an elastic impact, or of a swing about the load [s].
  double push = 0;      ///< Acceleration that closes the contact when they meet [m/s²].
  double swing = 0;     ///< Half a period of the support that carries them, [s]; 0: there is none.
  double pressed = 0;   ///< Without speed: for how long a load presses [s].
  bool driven = false;  ///< A load that swings for ever acts on them.
};

/// Of each contact; nothing where nothing that is known brings the two together before the end.
std::vector<std::optional<Encounter>> Foresee(const Scenario& scenario);

/// Duration of an elastic impact [s]:
///   T = 2 (δ_m/v) ∫₀¹ dξ/√(1 − ξ^{n+1}) = 2 (δ_m/v) √π Γ(1 + 1/(n+1))/Γ(½ + 1/(n+1)),
/// with δ_m = [(n+1) m_e v²/(2k)]^{1/(n+1)}; for n = 1.5 Hertz's 2.9433 δ_m/v.
double ImpactDuration(double effective_mass, double speed, double stiffness, double exponent);

/// Period of the small swing about a constant load F [s]: 2π/ω with k δ_eqⁿ = F and
/// ω² = n k δ_eqⁿ⁻¹/m_e.
double SwingPeriod(double effective_mass, double force, double stiffness, double exponent);

}  // namespace contact
