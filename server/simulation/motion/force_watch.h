#pragma once

#include <Eigen/Core>

#include "simulation/motion/moving_system.h"

namespace contact {

/// Takes the largest force and the time of tension over a step into the running cycles.
class ForceWatch {
 public:
  /// The system must outlive the watch.
  explicit ForceWatch(MovingSystem& system) : system_(system) {}

  /// Looks at a contact in the step.
  void Observe(const ActiveContact& active);

 private:
  /// Keeps the state at θ as that of the largest force.
  void KeepPeak(int contact, double theta);

  MovingSystem& system_;
  // y where F is largest.
  Eigen::ArrayXd inside_;
};

}  // namespace contact
