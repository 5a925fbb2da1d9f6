#include "simulation/clusters/world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "simulation/model/derived.h"

namespace contact {
namespace {

// Part of a sum that may be round-off.
constexpr double kNoise = 4 * std::numeric_limits<double>::epsilon();

}  // namespace

World::World(const Scenario& scenario)
    : scenario_(scenario),
      driven_(scenario),
      accelerations_(scenario.bodies.size()),
      flies_from_(scenario.bodies.size()),
      contacts_of_(scenario.bodies.size()),
      loads_of_(scenario.bodies.size()),
      supports_of_(scenario.bodies.size()),
      states_(InitialState(scenario).contacts),
      stations_(scenario.bodies.size()),
      waiting_(scenario.bodies.size()),
      changes_(scenario.bodies.size()) {
  for (std::size_t i = 0; i < scenario.loads.size(); ++i) {
    const Load& load = scenario.loads[i];
    if (!IsMoved(load.body)) continue;
    loads_of_[At(load.body)].push_back(static_cast<int>(i));
    if (IsSteady(load)) {
      accelerations_[At(load.body)] += load.constant / scenario.bodies[At(load.body)].mass;
    } else {
      flies_from_[At(load.body)] = std::max(flies_from_[At(load.body)], load.end);
    }
  }
  for (std::size_t i = 0; i < scenario.supports.size(); ++i) {
    const Support& support = scenario.supports[i];
    for (const int body : {support.other, support.body}) {
      if (IsMoved(body)) flies_from_[At(body)] = kNever;
    }
    const int first = IsMoved(support.body) ? support.body : support.other;
    if (IsMoved(first)) supports_of_[At(first)].push_back(static_cast<int>(i));
  }
  for (std::size_t b = 0; b < scenario.bodies.size(); ++b) {
    const Flight flight{.start = {.v = scenario.bodies[b].velocity},
                        .acceleration = accelerations_[b]};
    stations_[b].push_back({.from = 0, .flight = flight});
  }
  for (std::size_t c = 0; c < scenario.contacts.size(); ++c) {
    gaps_.push_back(InitialGap(scenario, scenario.contacts[c]));
    std::vector<int>& sides = sides_.emplace_back();
    for (const int body : {scenario.contacts[c].left, scenario.contacts[c].right}) {
      if (!IsMoved(body)) continue;
      sides.push_back(body);
      contacts_of_[At(body)].push_back(static_cast<int>(c));
    }
  }
}

// What touches and approaches begins when it is its turn, but for what waits together.
void World::Begin(const std::vector<Waiting>& groups) {
  Wait(groups);
  for (std::size_t c = 0; c < states_.size(); ++c) {
    const std::vector<int>& sides = sides_[c];
    const auto group = sides.empty() ? nullptr : waiting_[At(sides.front())];
    const bool together = group != nullptr && group == waiting_[At(sides.back())];
    if (!together) states_[c].phase = Phase::kOpen;
  }
}

int World::Other(int contact, int body) const {
  const Contact& c = scenario_.contacts[At(contact)];
  const int other = c.left == body ? c.right : c.left;
  return IsMoved(other) ? other : kNone;
}

// δ = u_left − u_right − gap, from displacements: positions would lose its digits.
double World::Gap(int contact, const Place& left, const Place& right) const {
  return gaps_[At(contact)] - left.u + right.u;
}

World::Distance World::DistanceAt(int contact, double instant) const {
  const Contact& c = scenario_.contacts[At(contact)];
  const Place left = PlaceOf(c.left, instant), right = PlaceOf(c.right, instant);
  return {Gap(contact, left, right), left.v - right.v};
}

double World::Noise(int contact, double instant) const {
  const Contact& c = scenario_.contacts[At(contact)];
  const double size = std::abs(gaps_[At(contact)]) + std::abs(PlaceOf(c.left, instant).u) +
                      std::abs(PlaceOf(c.right, instant).u);
  return kNoise * size;
}

double World::Approach(int contact) const {
  const Contact& c = scenario_.contacts[At(contact)];
  const double left = Acceleration(c.left), right = Acceleration(c.right);
  const double noise = kNoise * (std::abs(left) + std::abs(right));
  return std::abs(left - right) <= noise ? 0 : left - right;
}

Place World::PlaceOf(int body, double instant) const {
  if (!IsMoved(body)) return body == kNone ? Place{} : driven_.PlaceOf(body, instant);
  const std::vector<Station>& stations = stations_[At(body)];
  auto at = stations.end() - 1;
  while (at != stations.begin() && at->from > instant) --at;
  if (at->piece == nullptr) return at->flight.At(instant);
  const std::vector<int>& bodies = at->piece->start.bodies;
  const auto place = std::ranges::lower_bound(bodies, body) - bodies.begin();
  const Trace& trace = at->piece->trace;
  return trace.At(static_cast<std::size_t>(place), trace.StepAt(instant), instant);
}

double World::Stretch(const Support& support, const Place& body, const Place& other) const {
  return InitialStretch(scenario_, support) + body.u - other.u;
}

const Piece* World::LastPiece(int body) const {
  const std::vector<Station>& stations = stations_[At(body)];
  for (auto at = stations.rbegin(); at != stations.rend(); ++at) {
    if (at->piece != nullptr) return at->piece.get();
  }
  return nullptr;
}

double World::NextTouch(int contact) const {
  double from = 0;
  for (const int body : Sides(contact)) {
    if (waiting_[At(body)] != nullptr) return kNever;
    from = std::max(from, stations_[At(body)].back().from);
  }
  const Contact& c = scenario_.contacts[At(contact)];
  if (driven_.Moves(c.left) || driven_.Moves(c.right)) return NextTouchOfDriven(contact, from);
  const Distance d = DistanceAt(contact, from);
  const double gap = std::abs(d.gap) <= Noise(contact, from) ? 0 : d.gap;
  return from + TimeToTouch(gap, d.speed, Approach(contact));
}

// No touch comes before a body is where what is driven goes at the farthest, and none before the
// one that the largest δ̈ to come would bring: from there on anew, until the faces touch. Next to a
// touch this converges as Newton's method does.
double World::NextTouchOfDriven(int contact, double from) const {
  const Contact& c = scenario_.contacts[At(contact)];
  const double steady = Acceleration(c.left) - Acceleration(c.right);
  const Place left = PlaceOf(c.left, from), right = PlaceOf(c.right, from);
  const bool is_left = driven_.Moves(c.left);
  const double ahead = is_left ? driven_.MostDisplacement(c.left, 1, from) - left.u
                               : driven_.MostDisplacement(c.right, -1, from) + right.u;
  const double apart = Gap(contact, left, right) - ahead;
  double time = from;
  if (apart > 0) time += TimeToTouch(apart, is_left ? -right.v : left.v, steady);
  while (time < scenario_.end_time) {
    const double until = std::min(
        {driven_.NextBreak(c.left, time), driven_.NextBreak(c.right, time), scenario_.end_time});
    const double most = steady + driven_.MostAcceleration(c.left, 1, time, until) +
                        driven_.MostAcceleration(c.right, -1, time, until);
    const Distance d = DistanceAt(contact, time);
    const double gap = std::abs(d.gap) <= Noise(contact, time) ? 0 : d.gap;
    const double touch = time + TimeToTouch(gap, d.speed, most);
    if (touch <= time) return time;
    time = std::min(touch, until);
  }
  return kNever;
}

void World::ContactsAmong(const std::vector<int>& bodies, Cast* cast) const {
  for (const int body : bodies) {
    for (const int c : ContactsOf(body)) {
      const int other = Other(c, body);
      if (other != kNone && !std::ranges::binary_search(bodies, other)) continue;
      cast->contacts.push_back(c);
    }
  }
  std::vector<int>& all = cast->contacts;
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
}

Cast World::Assemble(const std::vector<int>& bodies, double instant, int touch) const {
  Cast cast;
  cast.time = instant;
  cast.bodies = bodies;
  ContactsAmong(bodies, &cast);
  for (const int body : bodies) {
    cast.places.push_back(stations_[At(body)].back().flight.At(instant));
  }
  for (const int c : cast.contacts) cast.states.push_back(states_[At(c)]);
  Touch(touch, &cast);
  std::vector<const Waiting*> groups;
  for (const int body : bodies) {
    const Waiting* group = waiting_[At(body)].get();
    if (group != nullptr && group->bodies.front() == body) groups.push_back(group);
  }
  if (groups.size() == 1 && groups[0]->bodies == bodies) {
    cast.outlook = groups[0]->outlook;
    return cast;
  }
  for (const Waiting* group : groups) {  // With others what was foreseen need not come.
    Outlook& all = cast.outlook;
    const Outlook& one = group->outlook;
    all.unknowns.insert(all.unknowns.end(), one.unknowns.begin(), one.unknowns.end());
    all.rest_ends.insert(all.rest_ends.end(), one.rest_ends.begin(), one.rest_ends.end());
    all.episode = std::max(all.episode, one.episode);
    const bool shorter = one.step > 0 && (all.step == 0 || one.step < all.step);
    if (shorter) all.step = one.step;
  }
  return cast;
}

// Gaps of open contacts whose bodies were not together before, and those that close now.
void World::Touch(int touch, Cast* cast) const {
  for (std::size_t i = 0; i < cast->contacts.size(); ++i) {
    const int c = cast->contacts[i];
    ContactState& state = cast->states[i];
    const std::vector<int>& sides = Sides(c);
    const auto& group = waiting_[At(sides.front())];
    const bool together = group != nullptr && group == waiting_[At(sides.back())];
    if (state.phase != Phase::kOpen || together) continue;
    const Distance d = DistanceAt(c, cast->time);
    state.gap = c == touch || std::abs(d.gap) <= Noise(c, cast->time) ? 0 : d.gap;
    if (state.gap > 0 || d.speed <= 0) continue;
    state.phase = Phase::kStarting;
    state.settled = false;
    state.cycle.kind = Cycle::Kind::kCollision;
  }
}

void World::Commit(const std::shared_ptr<Piece>& piece, const std::vector<Waiting>& groups) {
  for (std::size_t i = 0; i < piece->end.contacts.size(); ++i) {
    states_[At(piece->end.contacts[i])] = piece->end.states[i];
  }
  for (std::size_t i = 0; i < piece->end.bodies.size(); ++i) {
    const int body = piece->end.bodies[i];
    waiting_[At(body)] = nullptr;
    ++changes_[At(body)];
    std::vector<Station>& stations = stations_[At(body)];
    stations.push_back({.from = piece->begins(), .piece = piece});
    stations.push_back({.from = piece->ends(),
                        .flight = {.time = piece->ends(),
                                   .start = piece->end.places[i],
                                   .acceleration = Acceleration(body)}});
  }
  Wait(groups);
}

void World::Wait(const std::vector<Waiting>& groups) {
  for (const Waiting& group : groups) {
    const auto shared = std::make_shared<const Waiting>(group);
    for (const int body : group.bodies) waiting_[At(body)] = shared;
  }
}

void World::Undo(const Piece& piece) {
  for (std::size_t i = 0; i < piece.before.size(); ++i) {
    states_[At(piece.start.contacts[i])] = piece.before[i];
  }
  for (const int body : piece.start.bodies) {
    std::vector<Station>& stations = stations_[At(body)];
    while (stations.back().piece.get() != &piece) stations.pop_back();
    stations.pop_back();
    waiting_[At(body)] = nullptr;
    ++changes_[At(body)];
  }
  for (const auto& group : piece.waited) {
    for (const int body : group->bodies) waiting_[At(body)] = group;
  }
}

void World::Restore(std::vector<ContactState> contacts, std::vector<std::vector<Station>> stations,
                    const std::vector<Waiting>& groups) {
  states_ = std::move(contacts);
  stations_ = std::move(stations);
  std::ranges::fill(waiting_, nullptr);
  Wait(groups);
}

void World::Forget(int body, double instant) {
  std::vector<Station>& stations = stations_[At(body)];
  auto at = stations.end() - 1;
  while (at != stations.begin() && at->from >= instant) --at;
  if (at->piece != nullptr && at->piece->ends() <= instant) ++at;  // It is forgotten too.
  stations.erase(stations.begin(), at);
}

}  // namespace contact
