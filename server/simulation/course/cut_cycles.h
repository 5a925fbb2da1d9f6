#pragma once

#include <vector>

#include "simulation/course/course.h"

namespace contact {

/// The rows of the cycles that the end of the run cuts, where the last recording of `course` has
/// paused; its recorder has their groups then. Fills in the works of these cycles in `state`.
std::vector<Cycle> CutCycles(const Scenario& scenario, Course& course, State* state);

}  // namespace contact
