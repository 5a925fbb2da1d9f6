#include "simulation/motion/slips.h"

#include <cassert>

#include "simulation/model/index.h"

namespace contact {

// Where it sticks the spring is as long as its largest force makes it.
void Slips::Apply(const StepEvents::Found& found) {
  assert(found.event.kind == EventKind::kSlip || found.event.kind == EventKind::kStick);
  const auto i = At(found.support);
  const Support& support = system_.scenario.supports[i];
  const double stretch = system_.equations.Stretch(i, system_.rk.y0.data());
  Slip& slip = system_.equations.slips[i];
  if (found.event.kind == EventKind::kSlip) {
    slip.side = stretch > 0 ? 1 : -1;
  } else {
    slip.slack += stretch - slip.side * support.slip_force / support.stiffness;
    slip.side = 0;
    system_.tangents.Stick(i, system_.equations.SidesOf(support.body, support.other));
  }
  system_.RefreshActive();
}

}  // namespace contact
