#include "simulation/course/cycle_samples.h"

#include <algorithm>
#include <cmath>

namespace contact {
namespace {

// Steps of a cycle whose duration is not known.
constexpr double kSteps = 30;
// Samples nearer than this part of their spacing are one.
constexpr double kNear = 1e-3;

// Time between samples of a cycle in a step [s].
double Spacing(const ContactState& cycle, const StepTime& step, int samples_per_contact) {
  const double expected = cycle.duration > 0 ? cycle.duration : kSteps * step.h;
  const double passed = (step.At(1) - cycle.cycle.start_time) / (2 * expected);
  const double spacing = expected / samples_per_contact;
  return passed < 1 ? spacing : std::ldexp(spacing, std::ilogb(std::min(passed, 1e300)) + 1);
}

}  // namespace

void FindCycleSamples(const Scenario& scenario, const Motion& motion, const StepTime& step,
                      std::vector<CycleSample>* found) {
  found->clear();
  if (scenario.samples_per_contact == 0) return;
  const double end = step.At(1);
  double least = kNever;
  for (const ActiveContact& active : motion.equations().active) {
    const ContactState& contact = motion.contacts()[static_cast<std::size_t>(active.contact)];
    if (contact.phase == Phase::kResting) continue;
    const double spacing = Spacing(contact, step, scenario.samples_per_contact);
    if (!scenario.wants_all_contact_samples && spacing >= scenario.sample_interval) continue;
    const double start = contact.cycle.start_time;
    least = std::min(least, spacing);
    for (double i = std::floor((step.start - start) / spacing); start + i * spacing <= end; ++i) {
      if (start + i * spacing >= step.start) found->push_back({.time = start + i * spacing});
    }
  }
  std::ranges::sort(*found, {}, &CycleSample::time);
  for (CycleSample& sample : *found) sample.near = kNear * least;
}

}  // namespace contact
