#pragma once

#include "translate/impact.h"

namespace contact::translate {

/// How a simulator steps through a contact.
enum class Stepping {
  kAccurate,         ///< With error control, or in a way that is not known here.
  kSymplecticEuler,  ///< v⁺ = v + h a(x, v), x⁺ = x + h v⁺.
  kVerlet,           ///< Velocity Verlet, with the damper at the velocity of the half step.
  /// v⁺ = v + h a(x⁺, v⁺), x⁺ = x + h v⁺, of a linear law: a constraint with ERP and CFM.
  kImplicitEuler,
  kSpeculative,  ///< The same, which begins in the step that would pass over the touch: Bullet.
};

/// The e_N [-] of a collision in steps of one length: it depends on where in a step the touch
/// falls.
struct SteppedRebound {
  double least = 0, mean = 0, most = 0;
};

/// Steps of `step` [s] through the collision, for touches spread evenly over a step. Not for
/// kAccurate.
SteppedRebound Step(const ForceLaw& law, const Collision& collision, Stepping stepping,
                    double step);

}  // namespace contact::translate
