#include "simulation/clusters/meeting.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "simulation/model/index.h"

namespace contact {
namespace {

// Bodies stay together if they touch again within so many times what the piece has lasted: to part
// and to join costs passes anew, to fly together only steps. With a quarter of it 100 balls in gaps
// of 0.7 to 10 mm take 0.23 million steps for 0.11, with four times as much the same.
constexpr double kSoon = 1;
// An overlap that is a meeting [m]. What is less stores no energy that counts: k δ² of 1e9 N/m is
// 1e-17 J.
constexpr double kOverlap = 1e-13;

// Some bodies, of which some wait, joined two by two to groups.
class Gatherer {
 public:
  // `bodies`: ascending; they outlive this.
  explicit Gatherer(const std::vector<int>& bodies)
      : bodies_(bodies), of_(bodies.size()), waits_(bodies.size()) {
    std::iota(of_.begin(), of_.end(), 0);
  }

  // The bodies of a contact, or the two ends of a block, wait together.
  void Join(int body, int other) {
    const std::size_t a = First(body), b = First(other);
    of_[std::max(a, b)] = std::min(a, b);
    waits_[PlaceOf(body)] = waits_[PlaceOf(other)] = true;
  }
  void Wait(int body) { Join(body, body); }
  // What is in a block waits together; so does what does not fly yet.
  void AddWhatNeverFlies(const World& world, const Blocks& blocks, double instant) {
    for (const int body : bodies_) {
      const std::vector<int> block = blocks.With(body);
      if (block.size() > 1) Join(body, block.front());
      if (world.FliesFrom(body) > instant) Wait(body);
    }
  }
  // Whether two bodies wait together.
  bool Together(int body, int other) const {
    return waits_[PlaceOf(body)] && waits_[PlaceOf(other)] && First(body) == First(other);
  }
  // The groups, each in the order of its first body.
  std::vector<Waiting> Groups() const {
    std::vector<Waiting> groups;
    std::vector<std::size_t> group_of(bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (!waits_[i]) continue;
      const std::size_t first = First(bodies_[i]);
      if (first == i) {
        group_of[i] = groups.size();
        groups.emplace_back();
      }
      groups[group_of[first]].bodies.push_back(bodies_[i]);
    }
    return groups;
  }

 private:
  std::size_t PlaceOf(int body) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(bodies_, body) - bodies_.begin());
  }
  std::size_t First(int body) const {
    std::size_t i = PlaceOf(body);
    while (of_[i] != i) i = of_[i];
    return i;
  }

  const std::vector<int>& bodies_;
  std::vector<std::size_t> of_;
  std::vector<bool> waits_;
};

std::size_t PlaceOf(const Piece& piece, int body) {
  return static_cast<std::size_t>(std::ranges::lower_bound(piece.end.bodies, body) -
                                  piece.end.bodies.begin());
}

// ẍ of a body where the piece ends [m/s²].
double LastAcceleration(const Piece& piece, int body) {
  if (piece.trace.ends.empty()) return 0;
  return (piece.trace.ends.end() -
          std::ssize(piece.end.bodies))[static_cast<std::ptrdiff_t>(PlaceOf(piece, body))]
      .to_acceleration;
}

bool WillTouchSoon(const World& world, const Piece& piece, int contact, double gap) {
  const Contact& c = world.scenario().contacts[At(contact)];
  const double speed =
      piece.end.places[PlaceOf(piece, c.left)].v - piece.end.places[PlaceOf(piece, c.right)].v;
  const double acceleration = LastAcceleration(piece, c.left) - LastAcceleration(piece, c.right);
  return TimeToTouch(gap, speed, acceleration) <= kSoon * (piece.ends() - piece.begins());
}

// What is known of the motion of a body of the piece, or of another one.
class Path {
 public:
  // Of a body of the piece, which flies after it or not.
  Path(const World& world, const Piece& piece, int body, bool flies)
      : world_(world), body_(body), piece_(&piece), place_(PlaceOf(piece, body)) {
    until = flies ? kNever : piece.ends();
    last = piece.ends();
    after_ = {.time = piece.ends(),
              .start = piece.end.places[place_],
              .acceleration = world.Acceleration(body)};
  }
  // Of another body.
  Path(const World& world, int body) : world_(world), body_(body) {
    last = world.StationsOf(body).back().from;
    until = world.WaitingOf(body) == nullptr ? kNever : last;
  }

  Place At(double instant) const {
    if (piece_ == nullptr) return world_.PlaceOf(body_, instant);
    if (instant >= after_.time) return after_.At(instant);
    return piece_->trace.At(place_, piece_->trace.StepAt(instant), instant);
  }

  // Adds the ends of its steps between two instants [s].
  void AddEnds(double from, double to, std::vector<double>* ends) const {
    const auto add = [&](const Piece& piece) {
      for (std::size_t i = piece.trace.StepAt(from); i < piece.trace.steps.size(); ++i) {
        const double end = piece.trace.steps[i].At(1);
        if (end >= to) return;
        if (end > from) ends->push_back(end);
      }
    };
    if (piece_ != nullptr) return add(*piece_);
    for (const World::Station& station : world_.StationsOf(body_)) {
      if (station.piece != nullptr && station.piece->ends() > from) add(*station.piece);
    }
  }

  double until = 0;  // How far it is known [s].
  double last = 0;   // When its last flight begins, or could [s].

 private:
  const World& world_;
  const int body_;
  const Piece* piece_ = nullptr;
  std::size_t place_ = 0;
  Flight after_;
};

// Where two bodies of a contact overlap first between instants in which both move smoothly.
std::optional<double> FirstOverlap(const World& world, int contact, const Path& left,
                                   const Path& right, const std::vector<double>& instants) {
  const auto at = [&](double instant) {
    const Place l = left.At(instant), r = right.At(instant);
    return World::Distance{world.Gap(contact, l, r), l.v - r.v};
  };
  double from = instants.front();
  double speed = at(from).speed;
  for (const double to : instants) {
    const World::Distance d = at(to);
    if (d.gap < -kOverlap) return from;
    if (speed > 0 && d.speed < 0) {  // They are nearest in between.
      double low = from, high = to;
      for (int i = 0; i < 50 && low < high; ++i) {
        const double middle = 0.5 * (low + high);
        (at(middle).speed > 0 ? low : high) = middle;
      }
      if (at(low).gap < -kOverlap) return from;
    }
    from = to;
    speed = d.speed;
  }
  return std::nullopt;
}

}  // namespace

std::vector<Waiting> GroupsAtStart(const World& world, const Blocks& blocks) {
  std::vector<int> bodies;
  for (int body = 0; body < std::ssize(world.scenario().bodies); ++body) {
    if (world.IsMoved(body)) bodies.push_back(body);
  }
  Gatherer gatherer(bodies);
  for (int c = 0; c < std::ssize(world.contacts()); ++c) {
    const std::vector<int>& sides = world.Sides(c);
    const bool pressed = !sides.empty() && StartsPressed(world.contacts()[At(c)]);
    if (pressed) gatherer.Join(sides.front(), sides.back());
  }
  gatherer.AddWhatNeverFlies(world, blocks, 0);
  return gatherer.Groups();
}

std::vector<Waiting> GroupsAfter(const World& world, const Piece& piece, const Blocks& blocks) {
  const Cast& end = piece.end;
  if (piece.ends() >= world.scenario().end_time) return {};
  Gatherer gatherer(end.bodies);
  for (std::size_t i = 0; i < end.contacts.size(); ++i) {
    const std::vector<int>& sides = world.Sides(end.contacts[i]);
    const ContactState& state = end.states[i];
    const bool touches =
        state.phase != Phase::kOpen ||
        (sides.size() == 2 && WillTouchSoon(world, piece, end.contacts[i], state.gap));
    if (touches) gatherer.Join(sides.front(), sides.back());
  }
  gatherer.AddWhatNeverFlies(world, blocks, end.time);
  std::vector<Waiting> groups = gatherer.Groups();
  const bool whole = groups.size() == 1 && groups[0].bodies == end.bodies;
  for (Waiting& group : groups) {
    group.time = end.time;
    group.lasted = piece.ends() - piece.begins();
    group.outlook.step = end.outlook.step;
    group.outlook.episode = end.outlook.episode;
    if (whole) group.outlook = end.outlook;
  }
  if (whole) return groups;
  const auto group_with = [&](int contact) -> Waiting* {
    const std::vector<int>& sides = world.Sides(contact);
    if (!gatherer.Together(sides.front(), sides.back())) return nullptr;
    const auto has = [&](const Waiting& group) {
      return std::ranges::binary_search(group.bodies, sides.front());
    };
    return &*std::ranges::find_if(groups, has);
  };
  for (const Unknown& unknown : end.outlook.unknowns) {
    if (Waiting* group = group_with(unknown.id.contact)) group->outlook.unknowns.push_back(unknown);
  }
  for (const RestEnd& rest : end.outlook.rest_ends) {
    if (Waiting* group = group_with(rest.before.contact)) group->outlook.rest_ends.push_back(rest);
  }
  return groups;
}

std::optional<Meeting> FirstMeeting(const World& world, const Piece& piece,
                                    const std::vector<Waiting>& groups) {
  std::optional<Meeting> first;
  std::vector<double> instants;
  for (const int body : piece.start.bodies) {
    const bool waits = std::ranges::any_of(groups, [&](const Waiting& group) {
      return std::ranges::binary_search(group.bodies, body);
    });
    const Path inside(world, piece, body, !waits);
    for (const int contact : world.ContactsOf(body)) {
      const int other = world.Other(contact, body);
      if (other == kNone || std::ranges::binary_search(piece.start.bodies, other)) continue;
      const Path outside(world, other);
      const double from = piece.begins();
      const double to =
          std::min({inside.until, outside.until, std::max(inside.last, outside.last)});
      if (to <= from) continue;
      instants.assign({from, to});
      if (inside.last > from && inside.last < to) instants.push_back(inside.last);
      inside.AddEnds(from, to, &instants);
      outside.AddEnds(from, to, &instants);
      for (const World::Station& station : world.StationsOf(other)) {
        if (station.from > from && station.from < to) instants.push_back(station.from);
      }
      std::ranges::sort(instants);
      const bool is_left = world.scenario().contacts[At(contact)].left == body;
      const auto meets = FirstOverlap(world, contact, is_left ? inside : outside,
                                      is_left ? outside : inside, instants);
      if (meets && (!first || *meets < first->time)) first = {*meets, body, other};
    }
  }
  return first;
}

}  // namespace contact
