#pragma once

#include <string>

#include "simulation/motion/motion.h"

namespace contact {

/// What the motion is busy with, for people: its closed contacts, those of the strongest damping
/// first, three at most, each with δ [m], λ h of the step, and the work of its cycle so far [J].
std::string Whereabouts(const Scenario& scenario, const Motion& motion);

/// That, once a run has made a million steps; before it is busy with nothing: empty.
std::string BusyWith(const Scenario& scenario, const Motion& motion);

}  // namespace contact
