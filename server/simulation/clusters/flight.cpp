#include "simulation/clusters/flight.h"

#include <cmath>

namespace contact {

// The first root of ½ a t² + w t − g = 0 at which the gap closes, written without cancellation.
double TimeToTouch(double gap, double speed, double acceleration) {
  if (gap <= 0) {
    if (speed > 0 || (speed == 0 && acceleration > 0)) return 0;
    return acceleration > 0 ? -2 * speed / acceleration : kNever;
  }
  const double discriminant = speed * speed + 2 * acceleration * gap;
  if (discriminant < 0) return kNever;
  const double root = std::sqrt(discriminant);
  if (speed > 0) return 2 * gap / (speed + root);
  return acceleration > 0 ? (root - speed) / acceleration : kNever;
}

}  // namespace contact
