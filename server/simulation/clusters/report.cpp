#include "simulation/clusters/report.h"

namespace contact {

void Reporter::OnIteration(const Iteration& iteration) {
  Iteration told = iteration;
  told.episode = episode_;
  for (Iteration::Unknown& unknown : told.unknowns) unknown.contact = Whole(unknown.contact);
  observer_.OnIteration(told);
}

void Reporter::OnCycle(const Cycle& cycle) {
  Cycle told = cycle;
  told.contact = Whole(cycle.contact);
  told.episode = episode_;
  report_.items.push_back({told.end_time, told});
}

void Reporter::OnGrowth(const Group& group) {
  Group told = group;
  told.contact = Whole(group.contact);
  observer_.OnGrowth(told);
}

void Reporter::OnGroup(const Group& group) {
  Group told = group;
  told.contact = Whole(group.contact);
  report_.items.push_back({told.end_time, told});
}

void Reporter::OnWarning(const std::string& text) {
  report_.items.push_back({begin_, Report::Warning{text}});
}

}  // namespace contact
