#include "simulation/episode/iteration_log.h"

#include <cmath>

namespace contact {

void IterationLog::Begin(int episode, double start_time) {
  episode_ = episode;
  start_time_ = start_time;
  number_ = 0;
}

void IterationLog::Correct(const Sight& sight) {
  Report(sight, false);
  ++number_;
  ++total;
}

void IterationLog::Accept(const Sight& sight) { Report(sight, true); }

void IterationLog::Accept(const std::vector<Group>& recorded) {
  Sight sight;
  for (const Group& group : recorded) {
    GroupSight& seen = sight.groups.emplace_back();
    seen.id.contact = group.contact;
    seen.first_cycle = group.first_cycle;
    seen.mu = group.mu;
    seen.squared = group.restitution_out * group.restitution_out;
    seen.restitution_in = group.restitution_in;
  }
  Report(sight, true);
}

void IterationLog::Grow(const Sight& sight, const GroupId& id, const Unknown& unknown) {
  ++growths;
  growths_no_progress += unknown.growth == Growth::kNoProgress;
  Group group{.contact = id.contact, .encounter = id.encounter};
  if (const GroupSight* seen = sight.Find(id)) {
    group.first_cycle = seen->first_cycle;
    group.cycles = seen->cycles;
    group.start_time = seen->start_time;
    group.end_time = seen->end_time;
    group.restitution_in = seen->restitution_in;
  }
  group.growth = unknown.growth;
  group.mu = unknown.mu;
  observer_.OnGrowth(group);
}

void IterationLog::Report(const Sight& sight, bool accepted) {
  Iteration iteration;
  iteration.episode = episode_;
  iteration.number = number_;
  iteration.start_time = start_time_;
  iteration.accepted = accepted;
  for (const GroupSight& g : sight.groups) {
    iteration.unknowns.push_back({.contact = g.id.contact,
                                  .number = g.first_cycle,
                                  .mu = g.mu,
                                  .restitution_out = g.squared >= 0 ? std::sqrt(g.squared) : kNaN,
                                  .restitution_in = g.restitution_in,
                                  .residual = g.restitution_in * g.restitution_in - g.squared,
                                  .bracket_low = g.bracket_low,
                                  .bracket_high = g.bracket_high,
                                  .update = g.update});
  }
  observer_.OnIteration(iteration);
}

}  // namespace contact
