#pragma once

#include <optional>
#include <vector>

#include "simulation/model/scenario.h"

namespace contact {

/// Forecast of how the two sides of a contact first meet. It follows from velocities, gaps,
/// supports to the ground and loads; what other contacts do is not known.
struct FirstMeeting {
  /// Time of the meeting [s], ≥ 0.
  double start = 0;
  /// Speed of the impact [m/s], ≥ 0; 0: they touch at rest under a load.
  double speed = 0;
  /// Duration of an elastic impact, or of a swing about the load if speed is 0 [s], > 0.
  double duration = 0;
  /// Largest deformation of an impact with the contact's law, or of a swing about the load if speed
  /// is 0 [m], > 0.                                                                        (T3)
  double deformation = 0;
  /// Acceleration that closes the contact when they meet [m/s²]; negative: one that opens it.
  double push = 0;
  /// Half a period of the supports that carry the side that moves [s]; 0: no support.
  double swing = 0;
  /// If speed is 0: for how long a load presses them together [s]; else 0.
  double pressed = 0;
  /// Whether a sine load that never ends acts on one of the two.
  bool driven = false;
};

/// The forecast for each contact, in the order of Scenario::contacts. Empty where nothing known
/// brings the two sides together before the end of the run.
std::vector<std::optional<FirstMeeting>> ForecastFirstMeetings(const Scenario& scenario);

/// Duration of an elastic impact [s], of two sides with m_e [kg] that meet at v [m/s] > 0:  (T1)
///   T = 2 (δ_m/v) ∫₀¹ dξ/√(1 − ξ^{n+1}) = 2 (δ_m/v) √π Γ(1 + 1/(n+1))/Γ(½ + 1/(n+1)),
/// with δ_m = [(n+1) m_e v²/(2k)]^{1/(n+1)}. For n = 1.5 it is Hertz's 2.9433 δ_m/v.
double ImpactDuration(double effective_mass, double speed, double stiffness, double exponent);

/// Largest deformation δ [m] of an undamped contact with the energy E [J] ≥ 0 that a constant load
/// F [N] presses; E or F > 0:                                                             (T3)
///   k δⁿ⁺¹/(n + 1) = E + F δ.
double PressedDeformation(double energy, double force, double stiffness, double exponent);

/// Period 2π/ω [s] of the small swing about a constant load F [N] > 0:                     (T2)
///   k δ_eqⁿ = F, ω² = n k δ_eqⁿ⁻¹/m_e.
double SwingPeriod(double effective_mass, double force, double stiffness, double exponent);

}  // namespace contact
