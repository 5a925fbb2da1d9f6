#include "simulation/course/telling.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>

namespace contact {
namespace {

std::string NameOf(const Scenario& scenario, int contact) {
  return scenario.contacts[static_cast<std::size_t>(contact)].name;
}

std::string TextOfJump(const Scenario& scenario, const Group& group) {
  std::ostringstream text;
  text.precision(7);
  text << "contact " << NameOf(scenario, group.contact) << ", group " << group.number
       << ": no μ gives a restitution of " << group.restitution_in << "; it jumps from "
       << group.too_much.restitution << " at μ = " << group.too_much.mu << " to "
       << group.too_little.restitution << " at μ = " << group.too_little.mu << ", and has "
       << group.restitution_out;
  return text.str();
}

}  // namespace

void TellCycle(const Scenario& scenario, const Cycle& cycle, Observer& observer, RunState* run) {
  ++run->cycles;
  Outcome& outcome = run->outcome;
  const bool missed =
      cycle.status == Cycle::Status::kNotConverged || cycle.status == Cycle::Status::kInfeasible;
  if (missed) outcome.all_converged = false;
  outcome.cut_cycles +=
      cycle.status == Cycle::Status::kCut || cycle.status == Cycle::Status::kUnfinished;
  if (cycle.end != Cycle::End::kRunEnd && cycle.status != Cycle::Status::kSettled) {
    outcome.worst_identity_residual =
        std::max(outcome.worst_identity_residual, cycle.identity_residual);
  }
  observer.OnCycle(cycle);
  if (missed && scenario.solver.fail_if_not_converged && outcome.end == Outcome::End::kFinished) {
    outcome.end = Outcome::End::kNotConverged;
    outcome.message = "contact " + NameOf(scenario, cycle.contact) + ", cycle " +
                      std::to_string(cycle.number) + " did not reach its restitution";
  }
}

void TellGroup(const Scenario& scenario, const Group& group, Observer& observer) {
  observer.OnGroup(group);
  if (group.status == Cycle::Status::kJump) observer.OnWarning(TextOfJump(scenario, group));
}

double LoadImpulse(const Scenario& scenario, double time) {
  double impulse = 0;
  for (const Load& load : scenario.loads) {
    const double t = std::max(0.0, std::min(load.end, time) - load.begin);
    impulse += (std::abs(load.constant) + std::abs(load.amplitude)) * t +
               0.5 * std::abs(load.slope) * t * t;
  }
  return impulse;
}

double KineticEnergy(const Scenario& scenario, const std::vector<double>& velocities) {
  double energy = 0;
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
    if (scenario.bodies[i].fixed) continue;
    energy += 0.5 * scenario.bodies[i].mass * velocities[i] * velocities[i];
  }
  return energy;
}

Outcome::End EndOf(Motion::Pause pause) {
  switch (pause) {
    case Motion::Pause::kStopped:
      return Outcome::End::kStopped;
    case Motion::Pause::kStepLimit:
      return Outcome::End::kBudgetSteps;
    case Motion::Pause::kNumeric:
      return Outcome::End::kNumeric;
    default:
      return Outcome::End::kFinished;
  }
}

std::string WhyEnded(Outcome::End end, double time, const std::string& whereabouts) {
  const std::string at = " at t = " + std::to_string(time) + " s";
  if (end == Outcome::End::kStopped) return "stopped on request" + at;
  const std::string what = end == Outcome::End::kBudgetSteps ? "the step budget was spent"
                                                             : "the integration broke down";
  return what + " (" + whereabouts + ")" + at;
}

}  // namespace contact
