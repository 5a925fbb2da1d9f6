#pragma once

namespace contact::translate {

/// What a simulator does about a contact force that would pull the bodies together.
enum class Pull {
  kAllowed,         ///< Nothing: the force pulls before the bodies part. Law A.
  kClamped,         ///< The force is 0 where it would pull. Law B.
  kUndampedReturn,  ///< The damper acts in compression only. Law C.
  kLimitedDamper,   ///< The damper's force is at most as large as the spring's. Law D.
};

/// The force of a contact in a simulator, F = k δⁿ + c s δᵖ δ̇, limited as `pull` says. s is 1, or
/// rises from 0 at δ = 0 to 1 at `full_depth`, as a cubic without slope at both ends.
struct ForceLaw {
  double stiffness = 1;         ///< k [N/mⁿ], > 0.
  double exponent = 1;          ///< n [-], ≥ 1.
  double damping = 0;           ///< c [N·s/mᵖ⁺¹], ≥ 0.
  double damping_exponent = 0;  ///< p [-], ≥ 0.
  Pull pull = Pull::kAllowed;
  double full_depth = 0;  ///< [m], ≥ 0; 0: s = 1.
  /// True where the solver adds the load to the force of a closed contact, so that the spring does
  /// not carry the load: MuJoCo.
  bool carries_load = false;

  /// F [N] at the deformation δ [m], > 0, and δ̇ [m/s], under a load that presses [N].
  double Force(double deformation, double velocity, double load) const;
};

/// How two bodies meet.
struct Collision {
  double mass = 1;      ///< Effective mass m_e [kg], > 0.
  double velocity = 1;  ///< Approach velocity [m/s], > 0.
  double load = 0;      ///< Constant load P that presses the contact [N], ≥ 0.
};

/// What a collision gives back.
struct Rebound {
  /// ε [-]: ε² is the work of the restitution over that of the compression. NaN without a rebound.
  double restitution = 0;
  /// e_N [-]: velocity after over velocity before; 0 if the bodies do not part. Without a load it
  /// is ε; under a load P it is  e_N² = ε² − (1 − ε²) 2 P δ_m/(m_e v²).
  double velocity_ratio = 0;
  double duration = 0;     ///< From touch until the force ends [s].
  double deformation = 0;  ///< Largest δ [m].
  double peak_force = 0;   ///< Largest F [N].
  double pull = 0;         ///< Largest −F [N]; 0 if the force never pulls.
};

/// Integrates the collision from δ = 0 until the bodies part, or until they stop in restitution.
/// Relative accuracy about 1e-8.
Rebound Collide(const ForceLaw& law, const Collision& collision);

/// The length L = (m_e v²/k)^{1/(n+1)} [m] of the collision of an undamped spring, and with it the
/// time L/v: units in which k, m_e and v are 1.
double LengthUnit(const ForceLaw& law, const Collision& collision);

/// The unit of c [N·s/mᵖ⁺¹] that goes with LengthUnit.
double DampingUnit(const ForceLaw& law, const Collision& collision);

}  // namespace contact::translate
