#pragma once

#include <string>
#include <vector>

#include "simulation/episode/run_state.h"
#include "simulation/model/observer.h"
#include "simulation/motion/motion.h"

namespace contact {

/// A cycle enters the ledger: tells the observer, and counts it in the state of the run. Ends the
/// run where the scenario asks for that.
void TellCycle(const Scenario& scenario, const Cycle& cycle, Observer& observer, RunState* run);

/// A group has ended with the cycles just told.
void TellGroup(const Scenario& scenario, const Group& group, Observer& observer);

/// What loads can give and take from 0 to `time` at most [N·s].
double LoadImpulse(const Scenario& scenario, double time);

/// ½Σmv² of the bodies that are not fixed [J].
double KineticEnergy(const Scenario& scenario, const std::vector<double>& velocities);

/// Why a run has ended, unless the pause is one between episodes: then kFinished.
Outcome::End EndOf(Motion::Pause pause);

/// The sentence for that, with where it happened [s] and what was at work there.
std::string WhyEnded(Outcome::End end, double time, const std::string& whereabouts);

}  // namespace contact
