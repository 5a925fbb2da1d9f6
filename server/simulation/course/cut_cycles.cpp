#include "simulation/course/cut_cycles.h"

#include <cmath>
#include <cstddef>

#include "simulation/motion/cycle_works.h"

namespace contact {
namespace {

// What the end of the run hides of a cycle is not told as if it were known.
Cycle Cut(Cycle cycle) {
  cycle.separation_velocity = cycle.work_restitution = cycle.dissipated_restitution =
      cycle.external_restitution = cycle.restitution_out = cycle.identity_residual = kNaN;
  if (!std::isnan(cycle.turn_time)) return cycle;
  cycle.max_deformation = cycle.peak_force = cycle.work_compression = cycle.dissipated_compression =
      cycle.external_compression = kNaN;
  return cycle;
}

void CloseWorks(const Scenario& scenario, double time, ContactState& contact) {
  Cycle& cycle = contact.cycle;
  const Contact& law = scenario.contacts[static_cast<std::size_t>(cycle.contact)];
  if (contact.phase == Phase::kResting) {
    SetRest(law, time, cycle.end_deformation, contact.work, contact.external_work, &contact);
    return;
  }
  if (contact.phase == Phase::kRestitution) {
    SetRestitution(law, cycle.max_deformation, contact.work, contact.external_work, &contact);
  } else {
    cycle.max_deformation = cycle.end_deformation;
    SetCompression(law, cycle.end_deformation, contact.work, contact.external_work, &contact);
  }
}

}  // namespace

std::vector<Cycle> CutCycles(const Scenario& scenario, Course& course, State* state) {
  std::vector<Cycle> rows;
  const Motion& motion = course.motion();
  course.recorder().groups.clear();
  for (ContactState& contact : state->contacts) {
    if (!InTouch(contact.phase)) continue;
    Cycle& cycle = contact.cycle;
    const double* y = motion.integrator().y0.data();
    cycle.end = Cycle::End::kRunEnd;
    cycle.end_time = state->time;
    cycle.end_deformation = -contact.gap;
    cycle.separation_velocity =
        motion.equations().Relative(cycle.contact, y + motion.equations().bodies());
    CloseWorks(scenario, state->time, contact);
    course.recorder().FinishCut(contact);
    rows.push_back(contact.phase == Phase::kResting ? cycle : Cut(cycle));
  }
  return rows;
}

}  // namespace contact
