#include "simulation/episode/window.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "simulation/model/window.h"

namespace contact {
namespace {

constexpr int kFirst = 12;  // Cycles of the first window,
constexpr int kMore = 8;    // and how many more when these have their answer.
// Change of a final μ, in units of the restitution's tolerance.
constexpr double kFinal = 0.02;
// Part of what a pass sees that an episode has at least: else runs would crawl.
constexpr double kLeastAdvance = 1e-3;
// Distance of the end from the cycle that begins next, relative: round-off must not let it begin.
constexpr double kBefore = 1e-9;

}  // namespace

void Window::Begin(double start, int running, int known, int contacts, int longest) {
  start_ = start;
  most_ = MostWindowCycles(static_cast<std::size_t>(contacts));
  cycles_ = std::min(longest * std::max(kFirst, std::max(known, running) + kMore), most_);
}

// Whether the pass saw the ends of all groups that overlap with it in time: the μ of one whose end
// was not seen is a guess. Also of all that overlap with these, for one that grows late may change
// those before it by any amount.
bool Window::Foreseen(const GroupSight& of, const Sight& sight) const {
  double end = of.end_time;
  for (const GroupSight& g : sight.groups) {
    if (g.start_time >= of.end_time || !g.sought) continue;
    if (!g.ended) return false;
    end = std::max(end, g.end_time);
  }
  return std::ranges::all_of(sight.groups, [&](const GroupSight& g) {
    return g.ended || !g.sought || g.start_time >= end;
  });
}

bool Window::IsFinal(const GroupSight& g, const Sight& sight, Groups& groups, double change) const {
  Unknown& unknown = groups.At(g.id);
  const double before = std::exchange(unknown.settled_mu, g.mu);
  if (!g.sought) return true;
  if (!g.ended) return false;
  const bool apart = std::ranges::any_of(sight.quiet, [&](double t) { return t >= g.end_time; });
  const bool unchanged = g.weak || std::abs(g.mu - before) <= change * g.mu;
  if (!apart && !(unchanged && Foreseen(g, sight))) return false;
  if (g.separated) return true;
  // The next group of the encounter may still want to join it.
  const GroupSight* next = sight.Find({g.id.contact, g.id.encounter, g.id.place + 1});
  return next != nullptr && next->ended;
}

double Window::FinalUntil(const Sight& sight, Groups& groups, double tolerance, double end) {
  if (!sight.crowded) return std::min(sight.time, end);
  double final = sight.time, seen = sight.time;
  for (const GroupSight& g : sight.groups) {
    if (!IsFinal(g, sight, groups, kFinal * tolerance)) final = std::min(final, g.start_time);
    if (!g.ended && g.sought) seen = std::min(seen, g.start_time);
  }
  const auto advances = [&](double time) {
    return time > start_ && time - start_ > kLeastAdvance * (sight.time - start_);
  };
  if (!advances(final) && cycles_ < most_) {
    cycles_ = std::min(cycles_ + kMore, most_);
    return start_;
  }
  // At the largest window the episode ends where a group begins whose end was not seen, or where
  // all it has seen ends.
  if (!advances(final)) final = advances(seen) ? seen : sight.time;
  return final >= end ? end : final - kBefore * (final - start_);
}

}  // namespace contact
