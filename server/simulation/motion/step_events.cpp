#include "simulation/motion/step_events.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "simulation/model/index.h"
#include "simulation/motion/rest.h"

namespace contact {
namespace {

// What is this many times the error allowed is motion.
constexpr double kResolved = 100;
// A step meant to end in a separation has found it when so little of δ is left.
constexpr double kShort = 1e-3;
// A separation that is this part of its cycle away is now: in a step that short round-off of δ
// decides what happens to other contacts.
constexpr double kInstant = 1e-10;

}  // namespace

StepEvents::StepEvents(const MovingSystem& system)
    : system_(system), passed_(system.scenario.contacts.size()) {}

void StepEvents::Restart() { std::ranges::fill(passed_, 0.0); }

void StepEvents::Pass(int contact, double theta) { passed_[At(contact)] = theta; }

// What round-off and the integrator's error may make of the deformation of two bodies at relative
// rest [m].
double StepEvents::Noise(int contact) const {
  const Contact& c = system_.scenario.contacts[At(contact)];
  double noise = 0;
  for (const ActiveContact& active : system_.equations.active) {
    noise =
        std::max(noise, kResolved * system_.tolerance * system_.scales[At(active.contact)].length);
  }
  for (const int body : {c.left, c.right}) {
    if (body == kNone) continue;
    noise += 1e-12 * std::max(std::abs(system_.rk.y0[body]), std::abs(system_.rk.y1[body])) +
             1e-15 * (std::abs(system_.equations.base()[At(body)]) +
                      system_.scenario.bodies[At(body)].radius);
  }
  return noise;
}

double StepEvents::Drift(int contact) const {
  const double* v = system_.rk.y0.data() + system_.equations.bodies();
  return system_.step.h * system_.equations.Relative(contact, v);
}

StepEvents::Found StepEvents::First(int separating) const {
  Found first;
  first.event.theta = kNever;
  if (separating != kNone &&
      system_.step.h < kInstant * system_.contacts[At(separating)].duration) {
    return {separating, {EventKind::kSeparation, 0}};
  }
  for (int c = 0; c < system_.equations.contacts(); ++c) {
    const Phase phase = system_.contacts[At(c)].phase;
    const auto [start, end] = system_.PathEnds(c);
    if (system_.contacts[At(c)].woken) {
      const double moved = end.value - system_.contacts[At(c)].cycle.start_deformation;
      const double noise = Noise(c);  // What is below it may go either way.
      if (moved < -noise && first.event.theta > 0) first = {c, {EventKind::kRelease, 0}};
      if (moved <= noise) continue;
    }
    if (DeformationPath::IsPlain(phase, start, end)) continue;
    const double noise = phase == Phase::kOpen ? Noise(c) : 0;
    const DeformationPath path(start, end, Drift(c));
    auto event = FirstEvent(phase, path, passed_[At(c)], noise);
    if (!event) continue;
    // What was hardly pressed since it rested gives back what was stored before.
    const bool released = system_.contacts[At(c)].woken && event->kind == EventKind::kTurn &&
                          HardlyWorks(system_, c, path.Value(event->theta));
    if (released) event->kind = EventKind::kRelease;
    if (event->theta < first.event.theta) first = {c, *event};
  }
  if (first.contact == kNone && separating != kNone &&
      system_.Deformation(separating, system_.rk.y1.data()) <
          kShort * system_.Deformation(separating, system_.rk.y0.data())) {
    first = {separating, {EventKind::kSeparation, 1}};
  }
  FindSlips(&first);
  // Within round-off of the step's start is at its start.
  if (first.any() && first.event.theta < 1e-13) first.event.theta = 0;
  return first;
}

void StepEvents::FindSlips(Found* first) const {
  for (std::size_t i = 0; i < system_.scenario.supports.size(); ++i) {
    const Support& s = system_.scenario.supports[i];
    if (std::isinf(s.slip_force)) continue;
    const auto [start, end] = system_.StretchEnds(i);
    const auto event = FirstSlip(DeformationPath(start, end), s.slip_force / s.stiffness,
                                 system_.equations.slips[i].side);
    if (event && event->theta < first->event.theta) *first = {kNone, *event, static_cast<int>(i)};
  }
}

}  // namespace contact
