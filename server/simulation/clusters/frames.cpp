#include "simulation/clusters/frames.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace contact {
namespace {

std::size_t At(int index) { return static_cast<std::size_t>(index); }

}  // namespace

Frames::Frames(const World& world, Observer& observer, std::stop_token stop)
    : world_(world),
      scenario_(world.scenario()),
      observer_(observer),
      stop_(std::move(stop)),
      equations_(scenario_) {
  samples_.columns =
      static_cast<int>(1 + 2 * scenario_.bodies.size() + 4 * scenario_.contacts.size());
}

bool Frames::full() const {
  const bool asked = scenario_.sample_interval > 0 && scenario_.samples_per_contact > 0;
  return asked && next_ - regular_ >= scenario_.most_contact_samples;
}

void Frames::RecordUntil(double instant, const Pieces& pieces) {
  if (scenario_.sample_interval == 0) return;
  FindSamples(until_, instant, pieces);
  until_ = instant;
  std::size_t next = 0;
  while (true) {
    // The last sample is the end of the run, though the multiple of the interval may miss it.
    const double multiple = static_cast<double>(regular_) * scenario_.sample_interval;
    const double late = instant + 1e-9 * scenario_.sample_interval;
    const bool due = multiple <= late && multiple <= scenario_.end_time * (1 + 1e-12);
    const double regular = due ? multiple : kNever;
    const CycleSample wanted = next < wanted_.size() ? wanted_[next] : CycleSample{.time = kNever};
    if (!due && wanted.time == kNever) return;
    const bool in_cycle = wanted.time < regular - wanted.near;
    if (in_cycle) ++next;
    if (in_cycle && (wanted.time - last_ <= wanted.near || full())) continue;
    if (samples_.rows() == 0 && stop_.stop_requested()) cut_short_ = true;
    if (cut_short_) return;
    if (!in_cycle) ++regular_;
    Record(std::min(in_cycle ? wanted.time : regular, scenario_.end_time), pieces);
  }
}

void Frames::FindSamples(double from, double until, const Pieces& pieces) {
  wanted_.clear();
  if (full()) return;
  for (const auto& [number, piece] : pieces) {
    const auto& samples = piece->trace.samples;
    auto sample = std::ranges::lower_bound(samples, from, {}, &CycleSample::time);
    for (; sample != samples.end() && sample->time <= until; ++sample) wanted_.push_back(*sample);
  }
  std::ranges::stable_sort(wanted_, {}, &CycleSample::time);
}

// F of what is in touch, and with it ẍ of all bodies.
void Frames::FindForces(double instant, const Pieces& pieces) {
  for (std::size_t b = 0; b < a_.size(); ++b) a_[b] = world_.Acceleration(static_cast<int>(b));
  std::ranges::fill(force_, 0);
  for (const auto& [number, piece] : pieces) {
    if (piece->begins() > instant || piece->ends() < instant) continue;
    for (const Trace::Pressed& pressed : piece->trace.PressedIn(piece->trace.StepAt(instant))) {
      const double deformation = -world_.DistanceAt(pressed.contact, instant).gap;
      const double rate = equations_.Relative(pressed.contact, v_.data());
      double& force = force_[At(pressed.contact)];
      if (force != 0) continue;  // Where one piece ends and the next begins.
      force =
          equations_.Activate(pressed.contact, 0, pressed.mu, kNone).At(deformation, rate).force;
      const Sides& sides = equations_.sides(pressed.contact);
      a_[static_cast<std::size_t>(sides.left)] -= sides.left_inverse * force;
      a_[static_cast<std::size_t>(sides.right)] += sides.right_inverse * force;
    }
  }
}

void Frames::Record(double instant, const Pieces& pieces) {
  const std::size_t n = scenario_.bodies.size();
  for (auto* scratch : {&u_, &v_, &a_}) scratch->resize(n);
  force_.resize(scenario_.contacts.size());
  for (std::size_t b = 0; b < n; ++b) {
    const Place place = world_.At(static_cast<int>(b), instant);
    u_[b] = place.u;
    v_[b] = place.v;
  }
  FindForces(instant, pieces);
  auto& row = samples_.values;
  row.push_back(instant);
  for (std::size_t b = 0; b < n; ++b) {
    row.push_back(scenario_.bodies[b].position + u_[b]);
    row.push_back(v_[b]);
  }
  for (int c = 0; c < equations_.contacts(); ++c) {
    const Contact& contact = scenario_.contacts[At(c)];
    const auto of = [&](int body) {
      return body == kNone ? Place{} : Place{u_[At(body)], v_[At(body)]};
    };
    const double external =
        equations_.effective_mass(c) * equations_.Relative(c, a_.data()) + force_[At(c)];
    row.insert(row.end(), {-world_.Gap(c, of(contact.left), of(contact.right)),
                           equations_.Relative(c, v_.data()), force_[At(c)], external});
  }
  ++next_;
  last_ = instant;
  if (samples_.rows() == RowsPerChunk(samples_.columns)) Flush();
}

void Frames::Flush() {
  if (samples_.rows() == 0) return;
  samples_.first = next_ - samples_.rows();
  observer_.OnSamples(samples_);
  samples_.values.clear();
}

Sampling Frames::Save() const {
  Sampling now{.pending = samples_, .regular = regular_, .last = last_};
  now.pending.first = next_ - samples_.rows();
  return now;
}

void Frames::Restore(Sampling from, double time) {
  until_ = time;
  next_ = from.pending.first + from.pending.rows();
  regular_ = from.regular;
  last_ = from.last;
  samples_ = std::move(from.pending);
}

}  // namespace contact
