#include "simulation/clusters/frames.h"

#include <algorithm>
#include <utility>

#include "simulation/course/telling.h"
#include "simulation/model/contact_spring.h"
#include "simulation/model/index.h"

namespace contact {

Frames::Frames(const World& world, Observer& observer, std::stop_token stop)
    : world_(world),
      scenario_(world.scenario()),
      equations_(scenario_),
      loads_(scenario_.bodies.size()),
      log_(scenario_, std::move(stop),
           [&](const Samples& samples) { observer.OnSamples(samples); }),
      places_(scenario_.bodies.size()),
      velocities_(scenario_.bodies.size()),
      accelerations_(scenario_.bodies.size()),
      forces_(scenario_.contacts.size()),
      yields_(scenario_.contacts.size()) {
  for (const Load& load : scenario_.loads) {
    if (!scenario_.bodies[At(load.body)].fixed) loads_[At(load.body)] += load.constant;
  }
}

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
  std::ranges::stable_sort(turns_, {}, &Turn::time);
}

double Frames::Gap(int contact) const {
  const Contact& c = scenario_.contacts[At(contact)];
  const auto of = [&](int body) { return body == kNone ? Place{} : places_[At(body)]; };
  return world_.Gap(contact, of(c.left), of(c.right));
}

// F of what is in touch, and with it ẍ of all bodies.
void Frames::FindForces(double instant, const Pieces& pieces) {
  for (std::size_t b = 0; b < accelerations_.size(); ++b) {
    accelerations_[b] = world_.Acceleration(static_cast<int>(b));
  }
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
  AppendEnergies(instant, pieces, row);
}

void Frames::AppendEnergies(double instant, const Pieces& pieces, std::vector<double>* row) const {
  double stored = 0, dissipated = dissipated_, work = 0;
  for (int c = 0; c < equations_.contacts(); ++c) {
    stored += ElasticEnergy(scenario_.contacts[At(c)], -Gap(c), yields_[At(c)]);
  }
  for (const auto& [number, piece] : pieces) {
    if (piece->begins() < instant) dissipated += DissipatedIn(*piece, instant);
  }
  for (std::size_t b = 0; b < places_.size(); ++b) work += loads_[b] * places_[b].u;
  row->insert(row->end(), {KineticEnergy(scenario_, velocities_), stored, 0, dissipated, work});
}

// At the ends of steps it was recorded, and so it is at samples that the piece has asked for. At
// those of others it follows from the balance of its bodies since the begin of the step.
double Frames::DissipatedIn(const Piece& piece, double instant) const {
  const Trace& trace = piece.trace;
  if (trace.dissipated.empty()) return 0;
  const std::size_t step = trace.StepAt(instant);
  if (instant >= trace.steps[step].At(1)) return trace.dissipated[step];
  const double before = step == 0 ? 0 : trace.dissipated[step - 1];
  own_.clear();
  for (std::size_t b = 0; b < trace.bodies; ++b) {
    own_.push_back(trace.ends[step * trace.bodies + b].from);
  }
  const double from = EnergyOf(piece, own_);
  own_.clear();
  for (const int body : piece.start.bodies) own_.push_back(places_[At(body)]);
  return before + from - EnergyOf(piece, own_);
}

double Frames::EnergyOf(const Piece& piece, std::span<const Place> places) const {
  const std::vector<int>& bodies = piece.start.bodies;
  double energy = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const double mass = scenario_.bodies[At(bodies[b])].mass;
    energy += 0.5 * mass * places[b].v * places[b].v - loads_[At(bodies[b])] * places[b].u;
  }
  const auto of = [&](int body) {
    const auto found = std::ranges::lower_bound(bodies, body);
    if (found == bodies.end() || *found != body) return Place{};  // It stands still.
    return places[static_cast<std::size_t>(found - bodies.begin())];
  };
  for (const int c : piece.start.contacts) {
    const Contact& contact = scenario_.contacts[At(c)];
    energy +=
        ElasticEnergy(contact, -world_.Gap(c, of(contact.left), of(contact.right)), yields_[At(c)]);
  }
  return energy;
}

void Frames::Forget(const Piece& piece) {
  if (!piece.trace.dissipated.empty()) dissipated_ += piece.trace.dissipated.back();
}

}  // namespace contact
