#pragma once

#include <vector>

#include "simulation/motion/motion.h"

namespace contact {

/// A sample that is wanted because of a cycle.
struct CycleSample {
  double time = 0;  ///< [s].
  double near = 0;  ///< Not where another sample is as near as that [s].
};

/// The samples within a step that `motion` has made, at equal steps of each running cycle: so many
/// in the duration that the cycle is expected to have. From twice that duration on, each doubling
/// of the cycle has that many again: what creeps without end does not fill the trajectory. In the
/// order of time. See Scenario for how many, and for which cycles there are none.
void FindCycleSamples(const Scenario& scenario, const Motion& motion, const StepTime& step,
                      std::vector<CycleSample>* found);

}  // namespace contact
