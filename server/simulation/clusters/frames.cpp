#include "simulation/clusters/frames.h"

#include <algorithm>
#include <utility>

#include "simulation/clusters/flight_turns.h"
#include "simulation/course/telling.h"
#include "simulation/model/contact_spring.h"
#include "simulation/model/derived.h"
#include "simulation/model/index.h"

namespace contact {

Frames::Frames(const World& world, Observer& observer, std::stop_token stop)
    : world_(world),
      scenario_(world.scenario()),
      equations_(scenario_),
      log_(scenario_, std::move(stop),
           [&](const Samples& samples) { observer.OnSamples(samples); }),
      places_(scenario_.bodies.size()),
      velocities_(scenario_.bodies.size()),
      accelerations_(scenario_.bodies.size()),
      forces_(scenario_.contacts.size()),
      yields_(scenario_.contacts.size()) {}

void Frames::RecordUntil(double instant, const Pieces& pieces, std::int64_t steps) {
  if (scenario_.sample_interval == 0) return;
  FindSamples(until_, instant, pieces);
  FindTurns(until_, instant, pieces);
  until_ = instant;
  log_.TakeUntil(instant, wanted_, turns_, steps, [&](double time, std::vector<double>* row) {
    Append(std::min(time, scenario_.end_time), pieces, row);
  });
}

void Frames::FindSamples(double from, double until, const Pieces& pieces) {
  wanted_.clear();
  if (log_.full()) return;
  for (const auto& [number, piece] : pieces) {
    const auto& samples = piece->trace.samples;
    auto sample = std::ranges::lower_bound(samples, from, {}, &CycleSample::time);
    for (; sample != samples.end() && sample->time <= until; ++sample) wanted_.push_back(*sample);
  }
  std::ranges::stable_sort(wanted_, {}, &CycleSample::time);
}

// What begins at `until` may not be solved yet: its turns there come the next time.
void Frames::FindTurns(double from, double until, const Pieces& pieces) {
  turns_.clear();
  if (scenario_.turning_channels == 0) return;
  for (const auto& [number, piece] : pieces) {
    if (piece->begins() >= until) continue;
    const auto& turns = piece->trace.turns;
    auto turn = piece->begins() >= from ? turns.begin()
                                        : std::ranges::upper_bound(turns, from, {}, &Turn::time);
    for (; turn != turns.end() && turn->time <= until; ++turn) turns_.push_back(*turn);
  }
  if (scenario_.turning_channels > equations_.contacts()) {
    AddFlightTurns(world_, from, until, &turns_);
  }
  std::ranges::stable_sort(turns_, {}, &Turn::time);
}

double Frames::Gap(int contact) const {
  const Contact& c = scenario_.contacts[At(contact)];
  const auto of = [&](int body) { return body == kNone ? Place{} : places_[At(body)]; };
  return world_.Gap(contact, of(c.left), of(c.right));
}

void Frames::FindAccelerations(double instant) {
  for (std::size_t b = 0; b < accelerations_.size(); ++b) {
    const int body = static_cast<int>(b);
    accelerations_[b] = world_.Acceleration(body) + world_.driven().AccelerationOf(body, instant);
  }
  const auto push = [&](int body, double force) {
    if (world_.IsMoved(body)) accelerations_[At(body)] += force / scenario_.bodies[At(body)].mass;
  };
  for (const std::span<const Load> row : equations_.loads().rows()) {
    const Load* load = PieceRows<Load>::At(row, instant);
    if (load != nullptr && !IsSteady(*load)) push(load->body, LoadForce(*load, instant));
  }
  for (const Support& support : scenario_.supports) {
    const double force = SupportForce(support);
    push(support.body, force);
    push(support.other, -force);
  }
}

// F of what is in touch, and with it ẍ of all bodies.
void Frames::FindForces(double instant, const Pieces& pieces) {
  FindAccelerations(instant);
  std::ranges::fill(forces_, 0);
  std::ranges::fill(yields_, 0);
  for (const auto& [number, piece] : pieces) {
    if (piece->begins() > instant || piece->ends() < instant) continue;
    for (const Trace::Pressed& pressed : piece->trace.PressedIn(piece->trace.StepAt(instant))) {
      double& force = forces_[At(pressed.contact)];
      if (force != 0) continue;  // Where one piece ends and the next begins.
      const double rate = equations_.Relative(pressed.contact, velocities_.data());
      const ActiveContact active =
          equations_.Activate(pressed.contact, 0, pressed.mu, kNone, pressed.yield);
      yields_[At(pressed.contact)] = pressed.yield;
      force = active.At(-Gap(pressed.contact), rate).force;
      accelerations_[static_cast<std::size_t>(active.left)] -= active.left_inverse * force;
      accelerations_[static_cast<std::size_t>(active.right)] += active.right_inverse * force;
    }
  }
}

void Frames::Append(double instant, const Pieces& pieces, std::vector<double>* row) {
  for (std::size_t b = 0; b < places_.size(); ++b) {
    places_[b] = world_.PlaceOf(static_cast<int>(b), instant);
    velocities_[b] = places_[b].v;
    row->push_back(scenario_.bodies[b].position + places_[b].u);
    row->push_back(places_[b].v);
  }
  FindForces(instant, pieces);
  for (int c = 0; c < equations_.contacts(); ++c) {
    const double force = forces_[At(c)];
    const double external =
        equations_.effective_mass(c) * equations_.Relative(c, accelerations_.data()) + force;
    row->insert(row->end(), {-Gap(c), equations_.Relative(c, velocities_.data()), force, external});
  }
  row->insert(row->end(), accelerations_.begin(), accelerations_.end());
  const double supports = AppendSupports(row);
  AppendEnergies(instant, pieces, supports, row);
}

double Frames::Stretch(const Support& support) const {
  const auto of = [&](int body) { return body == kNone ? Place{} : places_[At(body)]; };
  return world_.Stretch(support, of(support.body), of(support.other));
}

double Frames::SupportForce(const Support& support) const {
  const auto velocity = [&](int body) { return body == kNone ? 0 : places_[At(body)].v; };
  const double rate = velocity(support.body) - velocity(support.other);
  const Spring spring(support.stiffness, support.higher, Stretch(support));
  return -spring.force - support.damping * rate;
}

double Frames::AppendSupports(std::vector<double>* row) const {
  double sum = 0;
  for (const Support& support : scenario_.supports) {
    const double energy = Spring(support.stiffness, support.higher, Stretch(support)).energy;
    row->insert(row->end(), {SupportForce(support), energy});
    sum += energy;
  }
  return sum;
}

void Frames::AppendEnergies(double instant, const Pieces& pieces, double supports,
                            std::vector<double>* row) const {
  double stored = 0;
  Exchanged exchanged = forgotten_;
  for (int c = 0; c < equations_.contacts(); ++c) {
    stored += ElasticEnergy(scenario_.contacts[At(c)], -Gap(c), yields_[At(c)]);
  }
  for (const auto& [number, piece] : pieces) {
    if (piece->begins() >= instant) continue;
    const Exchanged in = ExchangedIn(*piece, instant);
    exchanged.dissipated += in.dissipated;
    exchanged.load_work += in.load_work;
  }
  for (std::size_t b = 0; b < places_.size(); ++b) {
    exchanged.load_work += world_.SteadyForce(static_cast<int>(b)) * places_[b].u;
  }
  row->insert(row->end(), {KineticEnergy(scenario_, velocities_), stored, supports,
                           exchanged.dissipated, exchanged.load_work});
}

// At the ends of steps it was recorded, and so it is at samples that the piece has asked for. At
// those of others it follows from the balance of its bodies since the begin of the step.
Exchanged Frames::ExchangedIn(const Piece& piece, double instant) const {
  const Trace& trace = piece.trace;
  if (trace.exchanged.empty()) return {};
  if (instant >= piece.ends()) return {trace.exchanged.back().dissipated, piece.work};
  const std::size_t step = trace.StepAt(instant);
  double steady = 0;
  own_.clear();
  for (std::size_t b = 0; b < trace.bodies; ++b) {
    const int body = piece.start.bodies[b];
    own_.push_back(places_[At(body)]);
    steady += world_.SteadyForce(body) * (own_.back().u - piece.start.places[b].u);
  }
  const double work = trace.WorkAt(step, instant);
  double dissipated = trace.exchanged[step].dissipated;
  if (instant < trace.steps[step].At(1)) {
    const Trace::Exchange before = step == 0 ? Trace::Exchange{} : trace.exchanged[step - 1];
    dissipated = before.dissipated + work - before.work - EnergyOf(piece, own_, instant);
    for (std::size_t b = 0; b < trace.bodies; ++b) {
      own_[b] = trace.ends[step * trace.bodies + b].from;
    }
    dissipated += EnergyOf(piece, own_, trace.steps[step].start);
  }
  return {.dissipated = dissipated, .load_work = work - steady};
}

double Frames::EnergyOf(const Piece& piece, std::span<const Place> places, double instant) const {
  const std::vector<int>& bodies = piece.start.bodies;
  const auto of = [&](int body) {
    const auto found = std::ranges::lower_bound(bodies, body);
    if (found == bodies.end() || *found != body) return world_.driven().PlaceOf(body, instant);
    return places[static_cast<std::size_t>(found - bodies.begin())];
  };
  double energy = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    energy += 0.5 * scenario_.bodies[At(bodies[b])].mass * places[b].v * places[b].v;
    for (const int s : world_.SupportsOf(bodies[b])) {
      const Support& support = scenario_.supports[At(s)];
      const double stretch = world_.Stretch(support, of(support.body), of(support.other));
      energy += Spring(support.stiffness, support.higher, stretch).energy;
    }
  }
  for (const int c : piece.start.contacts) {
    const Contact& contact = scenario_.contacts[At(c)];
    const double gap = world_.Gap(c, of(contact.left), of(contact.right));
    energy += ElasticEnergy(contact, -gap, yields_[At(c)]);
  }
  return energy;
}

void Frames::Forget(const Piece& piece) {
  forgotten_.load_work += piece.work;
  if (!piece.trace.exchanged.empty()) {
    forgotten_.dissipated += piece.trace.exchanged.back().dissipated;
  }
}

}  // namespace contact
