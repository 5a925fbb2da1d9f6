#include "simulation/episode/front.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace contact {
namespace {

// An interval of time, from the first start to the last end of groups that overlap.
struct Span {
  double start = std::numeric_limits<double>::infinity();
  double end = -std::numeric_limits<double>::infinity();
  bool closed = true;  // All of them have ended.

  bool Meets(const GroupSight& g) const {
    return g.start_time < end && (!g.ended || g.end_time > start);
  }
};

// Widens the span by all groups that overlap it.
void Widen(Span& span, const Sight& sight, double before) {
  for (bool wider = true; wider;) {
    wider = false;
    for (const GroupSight& g : sight.groups) {
      if (g.weak || !g.sought || g.start_time >= before || !span.Meets(g)) continue;
      if (!g.ended) span.closed = false;
      if (g.start_time >= span.start && (!g.ended || g.end_time <= span.end)) continue;
      span.start = std::min(span.start, g.start_time);
      if (g.ended) span.end = std::max(span.end, g.end_time);
      wider = true;
    }
  }
}

Span FrontSpan(const Sight& sight, const Groups& groups, double tolerance, double before) {
  Span span;
  for (const GroupSight& g : sight.groups) {
    if (g.start_time >= before || !Misses(g, groups, tolerance)) continue;
    span.start = g.start_time;
    span.end = g.end_time;
    Widen(span, sight, before);
    break;
  }
  return span;
}

}  // namespace

bool Misses(const GroupSight& group, const Groups& groups, double tolerance) {
  if (!group.sought || !group.ended || group.weak) return false;
  const Unknown* unknown = groups.Find(group.id);
  if (unknown != nullptr && (unknown->Decided() || unknown->waits)) return false;
  return !(std::abs(group.Miss()) <= tolerance);
}

std::vector<GroupId> Front(const Sight& sight, const Groups& groups, double tolerance, double end) {
  std::vector<GroupId> front;
  const Span span = FrontSpan(sight, groups, tolerance, end);
  for (const GroupSight& g : sight.groups) {
    const Unknown* unknown = groups.Find(g.id);
    const bool open = unknown == nullptr || !unknown->Decided();
    if (g.sought && g.ended && !g.weak && open && g.start_time < end && span.Meets(g)) {
      front.push_back(g.id);
    }
  }
  return front;
}

std::vector<GroupId> EarliestPart(const std::vector<GroupId>& front, const Sight& sight,
                                  double tolerance) {
  std::vector<GroupId> part;
  const auto first = std::ranges::find_if(
      front, [&](const GroupId& id) { return !(std::abs(sight.Find(id)->Miss()) <= tolerance); });
  if (first == front.end()) return part;
  const GroupSight& earliest = *sight.Find(*first);
  for (const GroupId& id : front) {
    const GroupSight& g = *sight.Find(id);
    if (g.start_time < earliest.end_time && g.end_time > earliest.start_time) part.push_back(id);
  }
  return part;
}

double LastFinal(const Sight& sight, const std::vector<GroupId>& front) {
  const double front_starts = sight.Find(front.front())->start_time;
  double before = front_starts;
  for (const GroupSight& g : sight.groups) {
    if (g.separated || !g.sought || g.start_time >= before) continue;
    const GroupSight* next = sight.Find({g.id.contact, g.id.encounter, g.id.place + 1});
    const bool joins_none = next != nullptr && next->ended && next->end_time <= front_starts;
    if (!joins_none) before = g.start_time;
  }
  double last = 0;
  for (const double quiet : sight.quiet) {
    if (quiet <= before) last = quiet;
  }
  return last;
}

bool FrontIsComplete(const Sight& sight, const Groups& groups, double tolerance, double end) {
  const Span span = FrontSpan(sight, groups, tolerance, end);
  return span.start < span.end && span.closed;
}

bool MissIsComplete(const Sight& sight, const Groups& groups, double tolerance, double end,
                    std::size_t few) {
  const Span span = FrontSpan(sight, groups, tolerance, end);
  if (!(span.start < span.end)) return false;
  if (span.closed) return true;
  const auto in = [&](const GroupSight& g) {
    return g.sought && !g.weak && g.start_time < end && span.Meets(g);
  };
  return static_cast<std::size_t>(std::ranges::count_if(sight.groups, in)) > few;
}

}  // namespace contact
