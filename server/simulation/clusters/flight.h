#pragma once

#include "simulation/motion/state.h"

namespace contact {

/// Where a body is, and how fast.
struct Place {
  double u = 0;  ///< Displacement since t = 0 [m]: keeps the digits that positions lose.
  double v = 0;  ///< ẋ [m/s].
};

/// The path of a body that nothing touches, under a constant force.
struct Flight {
  double time = 0;          ///< When it begins [s],
  Place start;              ///< and where.
  double acceleration = 0;  ///< ẍ [m/s²].

  /// u = u₀ + v₀ t + ½ a t², at this instant [s].
  Place At(double instant) const {
    const double t = instant - time;
    return {start.u + t * (start.v + 0.5 * acceleration * t), start.v + acceleration * t};
  }
};

/// How long it takes until two faces touch [s], which are `gap` apart [m], come near at `speed`
/// [m/s], and ever faster by `acceleration` [m/s²]; kNever if they do not. Faces that touch, and
/// move apart, touch when they come back; those at rest as soon as they are pressed.
double TimeToTouch(double gap, double speed, double acceleration);

}  // namespace contact
