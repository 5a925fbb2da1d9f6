#include "simulation/episode/timeline.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "simulation/episode/search_options.h"
#include "simulation/model/columns.h"

namespace contact {
namespace {

std::vector<GroupId> InOrderOfEnds(std::vector<const GroupSight*> groups) {
  std::ranges::sort(groups, {}, &GroupSight::end_time);
  std::vector<GroupId> ids;
  for (const GroupSight* g : groups) ids.push_back(g->id);
  return ids;
}

}  // namespace

const GroupSight* Timeline::FirstMiss(double least) const {
  const GroupSight* first = nullptr;
  for (const GroupSight& g : sight_.groups) {
    if (g.start_time >= end_ || !groups_.Misses(g, least)) continue;
    if (first == nullptr || g.end_time < first->end_time) first = &g;
  }
  // A poor guess may end too early: what began before it has its turn.
  if (first != nullptr && IsPoor(*first)) {
    for (const GroupSight& g : sight_.groups) {
      if (g.start_time < first->start_time && g.end_time > first->start_time &&
          g.start_time < end_ && groups_.Misses(g, least))
        return &g;
    }
  }
  return first;
}

bool Timeline::IsPoor(const GroupSight& g) const {
  const Unknown* unknown = groups_.Find(g.id);
  return unknown != nullptr && !unknown->corrected && std::abs(g.Miss()) > kSearch.astray;
}

// Widens the span of the first miss by all that overlaps it, until no more comes to it.
bool Timeline::ShowsMiss(double least, std::size_t few) const {
  const GroupSight* miss = FirstMiss(least);
  if (miss == nullptr) return false;
  double start = miss->start_time, end = miss->end_time;
  std::size_t overlap = 0, before = 0;
  bool ended = true;
  do {
    before = std::exchange(overlap, 0);
    for (const GroupSight& g : sight_.groups) {
      if (g.weak || !g.sought || g.start_time >= std::min(end, end_)) continue;
      if (g.ended && g.end_time <= start) continue;
      ++overlap;
      ended = ended && g.ended;
      start = std::min(start, g.start_time);
      if (g.ended) end = std::max(end, g.end_time);
    }
  } while (overlap != before);
  return ended || overlap > few;
}

// Whether the search may move the μ of a group.
bool Timeline::MayChange(const GroupSight& g) const {
  const Unknown* unknown = groups_.Find(g.id);
  return g.sought && g.ended && !g.weak && unknown != nullptr && !unknown->Decided() &&
         !unknown->waits && g.start_time < end_;
}

std::vector<GroupId> Timeline::Overlapping(const GroupSight& miss, double until,
                                           bool settled) const {
  std::vector<const GroupSight*> left, in = {&miss};
  for (const GroupSight& g : sight_.groups) {
    if (IsPoor(g) && g.start_time > miss.start_time) continue;
    if (&g != &miss && MayChange(g) && g.end_time <= until && (settled || !settled_(g.id))) {
      left.push_back(&g);
    }
  }
  double start = miss.start_time, end = miss.end_time;
  for (bool wider = true; wider;) {
    wider = false;
    std::erase_if(left, [&](const GroupSight* g) {
      if (g->end_time <= start || g->start_time >= end) return false;
      start = std::min(start, g->start_time), end = std::max(end, g->end_time);
      in.push_back(g);
      return wider = true;
    });
  }
  return InOrderOfEnds(in);
}

std::vector<GroupId> Timeline::Block(const GroupSight& miss, std::size_t few,
                                     std::size_t most) const {
  std::vector<GroupId> all = Overlapping(miss, kNever, false);
  if (all.size() <= few) return all;
  all = Overlapping(miss, miss.end_time, false);
  if (all.size() > most) all.erase(all.begin(), all.end() - static_cast<std::ptrdiff_t>(most));
  return all;
}

std::vector<GroupId> Timeline::Solved(double least, double most) const {
  std::vector<const GroupSight*> in;
  for (const GroupSight& g : sight_.groups) {
    const double miss = std::abs(g.Miss());
    const bool open = !settled_(g.id) || miss > least;
    if (MayChange(g) && open && miss <= most) in.push_back(&g);
  }
  std::vector<GroupId> ids = InOrderOfEnds(in);
  if (ids.size() > kMostColumns) ids.resize(kMostColumns);
  return ids;
}

// Whether all groups that overlap it have ended, before the first miss does, and all that overlap
// these have ended: what is still a guess, or grows late, changes all that it overlaps.
bool Timeline::IsForeseen(const GroupSight& of, const GroupSight* miss) const {
  double end = of.end_time;
  for (const GroupSight& g : sight_.groups) {
    if (g.start_time >= of.end_time || !g.sought) continue;
    const bool guessed = miss != nullptr && g.end_time >= miss->end_time && MayChange(g);
    if (!g.ended || guessed) return false;
    end = std::max(end, g.end_time);
  }
  return std::ranges::all_of(sight_.groups, [&](const GroupSight& g) {
    return g.ended || !g.sought || g.start_time >= end;
  });
}

double Timeline::FinalUntil(const GroupSight* miss) const {
  double final = miss != nullptr ? miss->start_time : sight_.time;
  const auto is_final = [&](const GroupSight& g) {
    return g.ended && (g.end_time <= final || (settled_(g.id) && IsForeseen(g, miss)));
  };
  for (bool earlier = true; earlier;) {
    earlier = false;
    for (const GroupSight& g : sight_.groups) {
      if (g.start_time >= final || !g.sought) continue;
      bool is = is_final(g);
      if (is && !g.separated) {  // The next of the encounter may want to join it.
        const GroupSight* next = sight_.Find({g.id.contact, g.id.encounter, g.id.place + 1});
        is = next != nullptr && is_final(*next);
      }
      if (!is) final = g.start_time, earlier = true;
    }
  }
  return final;
}

}  // namespace contact
