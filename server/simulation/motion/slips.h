#pragma once

#include "simulation/motion/moving_system.h"
#include "simulation/motion/step_events.h"

namespace contact {

/// Springs of supports that begin to slip, and stick again. README.md, I9.
class Slips {
 public:
  /// The system must outlive this.
  explicit Slips(MovingSystem& system) : system_(system) {}

  /// The step has ended on this event of a support.
  void Apply(const StepEvents::Found& found);

 private:
  MovingSystem& system_;
};

}  // namespace contact
