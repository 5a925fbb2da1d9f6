#include "simulation/clusters/cluster_run.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "simulation/clusters/cluster_state.h"
#include "simulation/course/telling.h"
#include "simulation/model/index.h"

namespace contact {
namespace {

// How far back what is new may reach, in the longest times that pieces last: a merge begins where
// the earlier piece does, and may take in others that went on then. Of 140 random gases, a gas of
// 100,000 balls and a column the farthest went back by 2.3. More keeps more in memory.
constexpr double kBack = 16;
// So many times while as many pieces come as are kept it is looked what is certain. With 1 a gas of
// 40 balls has 5 checkpoints for more than 10 (tests/jobs/cluster_checkpoint_test.cpp); with 1 or
// 64 a gas of 10,000 takes the same time.
constexpr std::int64_t kOften = 8;
// Steps for nothing before bodies are bound together: as many as were of use, and those of a few
// joins. What is bound too early steps in vain for ever, and what is bound too late is solved too
// often; with a quarter or a sixteenth of the useful ones 100 balls in gaps of 0.06 to 0.9 mm (k
// 1e9) take 0.12 and 0.14 million steps for 0.10.
constexpr std::int64_t kWasted = 2000;
// How far those that wait look before they are solved, in times that their last piece has lasted.
// 60 balls in gaps of 0.2 to 3 mm (k 1e6) take 2.5 million steps with 0, 0.95 with 3, 1.06 with 12.
constexpr double kAhead = 3;
// A flight within a piece, of bodies at rest, on springs or under changing loads, lasts at most
// this part of the run: so far behind may be what is told, and so often are they looked at.
constexpr double kLongest = 1.0 / 64;

void Include(const std::vector<int>& more, std::vector<int>* in) {
  for (const int body : more) {
    const auto place = std::ranges::lower_bound(*in, body);
    if (place == in->end() || *place != body) in->insert(place, body);
  }
}

}  // namespace

ClusterRun::ClusterRun(const Scenario& scenario, Observer& observer, std::stop_token stop)
    : scenario_(scenario),
      observer_(observer),
      world_(scenario),
      solver_(world_, observer, stop),
      agenda_(world_),
      frames_(world_, observer, std::move(stop)) {
  run_.warned.resize(scenario.contacts.size());
  run_.unproven.resize(scenario.contacts.size());
  run_.missed.resize(kDampingLaws);
  blocks_.of.resize(scenario.bodies.size());
  for (const Support& support : scenario.supports) {
    if (world_.IsMoved(support.body) && world_.IsMoved(support.other)) {
      blocks_.Bind({support.body, support.other});
    }
  }
  world_.Begin(GroupsAtStart(world_, blocks_));
  agenda_.Begin();
  const Inventory start = InventoryOf(world_, 0);
  run_.start_energy = start.energy;
  run_.start_momentum = start.momentum;
  Scale(start);
}

Outcome ClusterRun::Run() {
  while (run_.outcome.end == Outcome::End::kFinished) {
    const Agenda::Entry entry = agenda_.Next();
    if (entry.time == kNever) break;
    Treat(entry);
    if (number_ >= look_at_) Advance();
  }
  if (run_.outcome.end == Outcome::End::kFinished) {
    TellUntil(scenario_.end_time);
    TellProgress();
  }
  frames_.Flush();
  if (frames_.misses_samples()) observer_.OnWarning(kSamplesAreFull);
  Summarize();
  return run_.outcome;
}

void ClusterRun::Treat(const Agenda::Entry& entry) {
  Attempt attempt{.time = entry.time,
                  .bodies = entry.group ? entry.group->bodies : world_.Sides(entry.contact),
                  .touch = entry.group ? kNone : entry.contact};
  if (entry.group && entry.group->bodies.size() > 2) {
    attempt.until = entry.time + kAhead * entry.group->lasted;
  }
  std::ranges::sort(attempt.bodies);
  Gather(std::vector<int>(attempt.bodies), &attempt);
  while (true) {
    Flood(&attempt);
    if (const auto failed = Rewind(attempt)) return Fail(*failed);
    if (attempt.until > attempt.time && Meets(&attempt)) continue;
    const std::shared_ptr<Piece> piece =
        Solve(attempt, std::min(scenario_.end_time, attempt.time + kLongest * scenario_.end_time));
    if (EndOf(piece->pause) != Outcome::End::kFinished) return Fail(*piece);
    const std::vector<Waiting> groups = GroupsAfter(world_, *piece, blocks_);
    const std::optional<Meeting> meeting = FirstMeeting(world_, *piece, groups);
    if (!meeting) return Keep(piece, groups);
    if (!Join(meeting->outside, &attempt)) return Fail(*piece);
    wasted_ += piece->steps;
    attempt.until = piece->ends();
  }
}

// Whether others are met soon, as far as a look can tell, which costs one pass; takes them in.
bool ClusterRun::Meets(Attempt* attempt) {
  const bool alone = std::ranges::none_of(attempt->bodies, [&](int body) {
    return std::ranges::any_of(world_.ContactsOf(body), [&](int contact) {
      const int other = world_.Other(contact, body);
      return other != kNone && !std::ranges::binary_search(attempt->bodies, other);
    });
  });
  if (alone) return false;
  const std::shared_ptr<Piece> seen = solver_.Look(
      world_.Assemble(attempt->bodies, attempt->time, attempt->touch), attempt->until, run_);
  Count(*seen);
  const std::optional<Meeting> meeting = FirstMeeting(world_, *seen, {});
  if (!meeting || EndOf(seen->pause) != Outcome::End::kFinished) return false;
  wasted_ += seen->steps;
  return Join(meeting->outside, attempt);
}

void ClusterRun::Keep(const std::shared_ptr<Piece>& piece, const std::vector<Waiting>& groups) {
  world_.Commit(piece, groups);
  agenda_.Note(piece->end.bodies);
  pieces_.emplace(piece->number, piece);
  useful_ += piece->steps;
}

// Takes in more bodies, with all whose motion has to begin anew for that, and goes back to an
// instant at which each is known. False, and changes nothing, if that is certain already.
bool ClusterRun::Gather(const std::vector<int>& more, Attempt* attempt) const {
  Attempt wider = *attempt;
  std::vector<int> pending = more;
  Include(more, &wider.bodies);
  const auto take = [&](const std::vector<int>& bodies) {
    for (const int body : bodies) {
      if (!std::ranges::binary_search(wider.bodies, body)) pending.push_back(body);
    }
    Include(bodies, &wider.bodies);
  };
  while (!pending.empty()) {
    const int body = pending.back();
    pending.pop_back();
    take(blocks_.With(body));
    if (const auto& group = world_.WaitingOf(body)) take(group->bodies);
    for (const World::Station& station : world_.StationsOf(body)) {
      const Piece* piece = station.piece.get();
      if (piece == nullptr || piece->ends() <= wider.time) continue;
      if (piece->IsFlight() && piece->begins() < wider.time) {  // Rewind cuts it.
        take(piece->start.bodies);
        continue;
      }
      if (piece->begins() < run_.state.time) return false;
      take(piece->start.bodies);
      if (piece->begins() >= wider.time) continue;
      wider.time = piece->begins();
      wider.touch = piece->touch;
      pending = wider.bodies;
      break;
    }
  }
  *attempt = std::move(wider);
  return true;
}

// Takes in what touches at the instant of the attempt and approaches. What only lies beside it is
// met when it is pressed: a pulse in a row of touching balls has what it has reached. It is looked
// for before anything is solved: without that a row of 40 balls at ε 0.9 takes 14,106 steps for
// 9,621.
void ClusterRun::Flood(Attempt* attempt) const {
  std::vector<int> pending = attempt->bodies;
  while (!pending.empty()) {
    const int body = pending.back();
    pending.pop_back();
    for (const int contact : world_.ContactsOf(body)) {
      const int other = world_.Other(contact, body);
      if (other == kNone || std::ranges::binary_search(attempt->bodies, other)) continue;
      const World::Distance d = world_.DistanceAt(contact, attempt->time);
      if (d.speed < 0 || d.gap > world_.Noise(contact, attempt->time)) continue;
      const bool approaches = d.speed > 0 || world_.Approach(contact) > 0;
      if (!approaches) attempt->until = scenario_.end_time;
      const double time = attempt->time;
      const std::size_t size = attempt->bodies.size();
      if (!approaches || !Gather({other}, attempt)) continue;
      pending.push_back(other);
      if (attempt->time == time && attempt->bodies.size() == size + 1) continue;
      pending = attempt->bodies;  // More bodies or an earlier instant came along.
      break;
    }
  }
}

// Takes in a body that is met, and behind it twice as many as the last time, if they are at hand:
// what comes one by one would have the piece solved as often. Where many steps are made for nothing
// clusters are too small: these stay together for good. False if what the body did is certain.
bool ClusterRun::Join(int body, Attempt* attempt) {
  if (!Gather({body}, attempt)) return false;
  const std::size_t most = std::size_t{1} << std::min(attempt->joins++, 20);
  std::vector<int> joined = {body};
  for (std::size_t i = 0; i < joined.size() && joined.size() < most; ++i) {
    for (const int contact : world_.ContactsOf(joined[i])) {
      const int other = world_.Other(contact, joined[i]);
      if (other == kNone || std::ranges::binary_search(attempt->bodies, other)) continue;
      const Piece* last = world_.LastPiece(other);
      const bool free =
          world_.WaitingOf(other) == nullptr && (last == nullptr || last->ends() <= attempt->time);
      if (free && Gather({other}, attempt)) joined.push_back(other);
    }
  }
  if (wasted_ < kWasted + useful_) return true;
  blocks_.Bind(attempt->bodies);
  wasted_ = useful_ = 0;
  return true;
}

// Undoes what the bodies did after the instant of the attempt; a flight that goes on then ends
// there instead. Returns a piece that fails, or null.
std::shared_ptr<Piece> ClusterRun::Rewind(const Attempt& attempt) {
  std::vector<std::shared_ptr<Piece>> cut;
  for (const int body : attempt.bodies) {
    for (const Piece* last = world_.LastPiece(body); last != nullptr && last->ends() > attempt.time;
         last = world_.LastPiece(body)) {
      useful_ -= last->steps;
      wasted_ += last->steps;
      const std::shared_ptr<Piece> undone = Undo(*last);
      if (undone->begins() < attempt.time) cut.push_back(undone);
    }
  }
  for (const std::shared_ptr<Piece>& flight : cut) {
    std::shared_ptr<Piece> piece =
        Solve({.time = flight->begins(), .bodies = flight->start.bodies}, attempt.time);
    if (EndOf(piece->pause) != Outcome::End::kFinished) return piece;
    Keep(piece, GroupsAfter(world_, *piece, blocks_));
  }
  return nullptr;
}

// A piece, and before it those that came later.
std::shared_ptr<Piece> ClusterRun::Undo(const Piece& piece) {
  for (const int body : std::vector<int>(piece.start.bodies)) {
    for (const Piece* last = world_.LastPiece(body); last != &piece;
         last = world_.LastPiece(body)) {
      Undo(*last);
    }
  }
  std::shared_ptr<Piece> undone = pieces_.extract(piece.number).mapped();
  world_.Undo(*undone);
  agenda_.Note(undone->start.bodies);
  return undone;
}

std::shared_ptr<Piece> ClusterRun::Solve(const Attempt& attempt, double until) {
  Cast cast = world_.Assemble(attempt.bodies, attempt.time, attempt.touch);
  std::vector<ContactState> before;
  for (const int contact : cast.contacts) before.push_back(world_.contacts()[At(contact)]);
  std::vector<std::shared_ptr<const Waiting>> waited;
  for (const int body : attempt.bodies) {
    const auto& group = world_.WaitingOf(body);
    if (group != nullptr && group->bodies.front() == body) waited.push_back(group);
  }
  std::shared_ptr<Piece> piece = solver_.Solve(std::move(cast), ++number_, until, run_);
  piece->touch = attempt.touch;
  piece->before = std::move(before);
  piece->waited = std::move(waited);
  busy_with_ = piece->whereabouts;
  Count(*piece);
  return piece;
}

void ClusterRun::Count(const Piece& piece) {
  run_.steps += piece.steps;
  run_.evaluations += piece.evaluations;
  run_.iterations += piece.iterations;
  run_.growths += piece.growths;
  run_.growths_no_progress += piece.growths_no_progress;
}

// What was found before is told, as far as nothing can undo it.
void ClusterRun::Fail(const Piece& piece) {
  agenda_.Note(piece.start.bodies);
  Advance();
  const Outcome::End end = EndOf(piece.pause);
  if (end == Outcome::End::kFinished) {
    run_.outcome.end = Outcome::End::kNumeric;
    run_.outcome.message =
        "bodies meet whose past is told already, at t = " + std::to_string(piece.ends()) + " s";
  } else {
    run_.outcome.end = end;
    run_.outcome.message = WhyEnded(end, piece.ends(), piece.whereabouts);
  }
}

// Tells what is certain. What is solved from now on may begin together with a piece that goes on
// now, and so from where that begins; and that with others that went on there, and so on.
void ClusterRun::Advance() {
  const double now = agenda_.NextTime();
  double certain = std::min(now, scenario_.end_time);
  double longest = 0;
  for (const auto& [number, piece] : pieces_) {
    if (piece->ends() > now) certain = std::min(certain, piece->begins());
    if (piece->has_episode) longest = std::max(longest, piece->ends() - piece->begins());
  }
  const bool alone = std::ranges::none_of(pieces_, [&](const auto& entry) {
    return entry.second->begins() < certain && entry.second->ends() > certain;
  });
  if (!alone) certain = std::min(certain, now - kBack * longest);
  look_at_ = number_ + 1 + std::ssize(pieces_) / kOften;
  if (certain <= run_.state.time) return;
  TellUntil(certain);
  TellProgress();
  if (run_.state.time < scenario_.end_time) observer_.OnBoundary([this] { return Save(); });
}

void ClusterRun::TellProgress() {
  observer_.OnProgress({.time = run_.state.time,
                        .steps = run_.steps,
                        .cycles = run_.cycles,
                        .iterations = run_.iterations,
                        .busy_with = busy_with_});
}

void ClusterRun::TellUntil(double instant) {
  struct Next {
    double time;
    std::int64_t number;
    const Report::News* news;
  };
  std::vector<Next> news;
  for (const auto& [number, piece] : pieces_) {
    auto& told = piece->told;
    for (; told < piece->report.items.size() && piece->report.items[told].time <= instant; ++told) {
      const Report::Item& item = piece->report.items[told];
      news.push_back({item.time, piece->number, &item.news});
    }
  }
  std::ranges::stable_sort(news, {}, [](const Next& n) { return std::pair(n.time, n.number); });
  frames_.RecordUntil(instant, pieces_, run_.steps);
  if (frames_.cut_short() && run_.outcome.end == Outcome::End::kFinished) {
    run_.outcome.end = Outcome::End::kStopped;
    run_.outcome.message = WhyEnded(Outcome::End::kStopped, run_.state.time, {});
    return;
  }
  for (const Next& next : news) Tell(*next.news);
  ForgetUntil(instant);
  run_.state.time = instant;
}

void ClusterRun::Tell(const Report::News& news) {
  if (run_.outcome.end != Outcome::End::kFinished) return;
  if (const auto* warning = std::get_if<Report::Warning>(&news)) observer_.OnWarning(warning->text);
  if (const auto* cycle = std::get_if<Cycle>(&news)) {
    TellCycle(scenario_, *cycle, observer_, &run_);
  }
  if (const auto* group = std::get_if<Group>(&news)) TellGroup(scenario_, *group, observer_);
}

void ClusterRun::ForgetUntil(double instant) {
  std::erase_if(pieces_, [&](const auto& entry) {
    const std::shared_ptr<Piece>& piece = entry.second;
    if (piece->ends() > instant) return false;
    run_.outcome.episodes += piece->has_episode;
    frames_.Forget(*piece);
    loss_ += piece->loss;
    work_ += piece->work;
    impulse_ += piece->impulse;
    for (std::size_t i = 0; i < piece->start.contacts.size(); ++i) {
      const std::size_t contact = At(piece->start.contacts[i]);
      run_.warned[contact] = run_.warned[contact] || piece->warned[i];
      run_.unproven[contact] = run_.unproven[contact] || piece->unproven[i];
    }
    for (std::size_t i = 0; i < run_.missed.size(); ++i) {
      run_.missed[i] = run_.missed[i] || piece->missed[i];
    }
    for (const int body : piece->start.bodies) world_.Forget(body, instant);
    return true;
  });
}

RunState ClusterRun::Save() const {
  RunState saved = run_;
  saved.state.contacts = world_.contacts();
  saved.sampling = frames_.Save();
  ClusterState clusters;
  for (const auto& [number, piece] : pieces_) clusters.pieces.push_back(*piece);
  for (int b = 0; b < std::ssize(scenario_.bodies); ++b) {
    auto& stations = clusters.stations.emplace_back();
    for (const World::Station& station : world_.StationsOf(b)) {
      const std::int64_t piece = station.piece == nullptr ? 0 : station.piece->number;
      stations.push_back({station.from, piece, station.flight});
    }
    const auto& group = world_.WaitingOf(b);
    if (group != nullptr && group->bodies.front() == b) clusters.waiting.push_back(*group);
  }
  clusters.number = number_;
  clusters.look_at = look_at_;
  clusters.blocks = blocks_.All();
  clusters.useful = useful_;
  clusters.wasted = wasted_;
  clusters.dissipated = frames_.dissipated();
  clusters.loss = loss_;
  clusters.work = work_;
  clusters.impulse = impulse_;
  saved.clusters = std::make_shared<const ClusterState>(std::move(clusters));
  return saved;
}

void ClusterRun::Restore(const RunState& from) {
  const ClusterState& clusters = *from.clusters;
  run_ = from;
  run_.clusters = nullptr;
  run_.state.contacts.clear();
  for (const Piece& piece : clusters.pieces) {
    pieces_.emplace(piece.number, std::make_shared<Piece>(piece));
  }
  std::vector<std::vector<World::Station>> stations;
  for (const auto& of_body : clusters.stations) {
    auto& own = stations.emplace_back();
    for (const ClusterState::Station& station : of_body) {
      own.push_back({.from = station.from,
                     .piece = station.piece == 0 ? nullptr : pieces_.at(station.piece),
                     .flight = station.flight});
    }
  }
  world_.Restore(from.state.contacts, std::move(stations), clusters.waiting);
  for (const std::vector<int>& block : clusters.blocks) blocks_.Bind(block);
  number_ = clusters.number;
  look_at_ = clusters.look_at;
  useful_ = clusters.useful;
  wasted_ = clusters.wasted;
  loss_ = clusters.loss;
  work_ = clusters.work;
  impulse_ = clusters.impulse;
  agenda_.Begin();
  frames_.Restore(from.sampling, from.state.time,
                  {.dissipated = clusters.dissipated, .load_work = clusters.work});
}

// The larger energy and momentum of begin and end, to which the balances are relative.
void ClusterRun::Scale(const Inventory& now) {
  run_.momentum_scale = std::max(run_.momentum_scale, now.momentum_scale);
  run_.energy_scale = std::max(run_.energy_scale, now.energy);
}

void ClusterRun::Summarize() {
  Outcome& outcome = run_.outcome;
  outcome.time = run_.state.time;
  for (int b = 0; b < std::ssize(scenario_.bodies); ++b) {
    const Place place = world_.PlaceOf(b, outcome.time);
    outcome.positions.push_back(scenario_.bodies[At(b)].position + place.u);
    outcome.velocities.push_back(place.v);
  }
  outcome.steps = run_.steps;
  outcome.evaluations = run_.evaluations;
  outcome.iterations = run_.iterations;
  outcome.growths = run_.growths;
  outcome.growths_no_progress = run_.growths_no_progress;
  outcome.kinetic_energy = KineticEnergy(scenario_, outcome.velocities);
  if (outcome.end != Outcome::End::kFinished) return;
  const Inventory now = InventoryOf(world_, outcome.time);
  Scale(now);
  double work = work_, impulse = impulse_;
  for (int b = 0; b < std::ssize(scenario_.bodies); ++b) {
    work += world_.SteadyForce(b) * world_.PlaceOf(b, outcome.time).u;
    impulse += world_.SteadyForce(b) * outcome.time;
  }
  run_.energy_scale = std::max(run_.energy_scale, std::abs(work));
  if (run_.energy_scale > 0) {
    outcome.energy_residual =
        std::abs(now.energy - run_.start_energy - work + loss_) / run_.energy_scale;
  }
  const double exchanged = std::max(run_.momentum_scale, LoadImpulse(scenario_, outcome.time));
  if (exchanged > 0) {
    outcome.momentum_residual = std::abs(now.momentum - run_.start_momentum - impulse) / exchanged;
  }
}

}  // namespace contact
