#include "simulation/sampler.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

namespace contact {

Sampler::Sampler(const Scenario& scenario, Motion& motion, Observer& observer, std::stop_token stop)
    : scenario_(scenario), motion_(motion), observer_(observer), stop_(std::move(stop)) {
  samples_.columns =
      static_cast<int>(1 + 2 * scenario.bodies.size() + 4 * scenario.contacts.size());
}

void Sampler::RecordStart(const State& state) {
  if (scenario_.sample_interval == 0) return;
  motion_.Begin(state, true);
  Record(0, motion_.integrator().y0);
  regular_ = 1;
}

void Sampler::OnStep(const StepTime& step) {
  if (scenario_.sample_interval == 0) return;
  FindCycleSamples(motion_, step, full() ? 0 : scenario_.samples_per_contact, &planned_);
  bool prepared = false;
  std::size_t next = 0;  // In planned_.
  while (true) {
    const double regular = NextRegular(step);
    const CycleSample planned =
        next < planned_.size() ? planned_[next] : CycleSample{.time = kNever};
    if (regular == kNever && planned.time == kNever) return;
    const bool in_cycle = planned.time < regular - planned.near;
    if (in_cycle) ++next;
    if (in_cycle && !Wants(planned)) continue;
    // A step may have millions of samples. Looked at once a chunk.
    if (samples_.rows() == 0 && stop_.stop_requested()) {
      cut_short_ = true;
      return;
    }
    if (!prepared) motion_.PrepareInterpolation();
    prepared = true;
    const double time = in_cycle ? planned.time : regular;
    motion_.Interpolate(std::clamp(step.Theta(time), 0.0, 1.0), &y_);
    if (!in_cycle) ++regular_;
    Record(std::min(time, scenario_.end_time), y_);
  }
}

double Sampler::NextRegular(const StepTime& step) const {
  const double time = static_cast<double>(regular_) * scenario_.sample_interval;
  // The last sample is the end of the run, though the multiple of the interval may miss it.
  const double late = step.At(1) + 1e-9 * scenario_.sample_interval;
  return time > late || time > scenario_.end_time * (1 + 1e-12) ? kNever : time;
}

bool Sampler::Wants(const CycleSample& sample) const {
  return sample.time - last_ > sample.near && !full();
}

bool Sampler::full() const {
  const bool asked = scenario_.sample_interval > 0 && scenario_.samples_per_contact > 0;
  return asked && next_ - regular_ >= scenario_.most_contact_samples;
}

void Sampler::Record(double time, const Eigen::ArrayXd& y) {
  const Equations& equations = motion_.equations();
  const int n = equations.bodies();
  slope_.resize(y.size());
  equations(time, y.data(), slope_.data());
  auto& row = samples_.values;
  row.push_back(time);
  for (int i = 0; i < n; ++i) {
    row.push_back(equations.base()[static_cast<std::size_t>(i)] + y[i]);
    row.push_back(y[n + i]);
  }
  auto active = equations.active.begin();  // In the order of the contacts, as this loop.
  for (int c = 0; c < equations.contacts(); ++c) {
    const double deformation = motion_.Deformation(c, y.data());
    const double rate = equations.Relative(c, y.data() + n);
    double force = 0;
    if (active != equations.active.end() && active->contact == c) {
      force = (active++)->At(deformation, rate).force;
    }
    const double external =
        equations.effective_mass(c) * equations.Relative(c, slope_.data() + n) + force;
    row.insert(row.end(), {deformation, rate, force, external});
  }
  ++next_;
  last_ = time;
  if (samples_.rows() == RowsPerChunk(samples_.columns)) Flush();
}

void Sampler::Flush() {
  if (samples_.rows() == 0) return;
  samples_.first = next_ - samples_.rows();
  if (before_) {
    held_.push_back(samples_);
  } else {
    observer_.OnSamples(samples_);
  }
  samples_.values.clear();
}

Sampling Sampler::Save() const {
  Sampling now{.pending = samples_, .regular = regular_, .last = last_};
  now.pending.first = next_ - samples_.rows();
  return now;
}

void Sampler::Restore(Sampling from) {
  next_ = from.pending.first + from.pending.rows();
  regular_ = from.regular;
  last_ = from.last;
  samples_ = std::move(from.pending);
}

void Sampler::Hold() { before_ = Save(); }

void Sampler::Release() {
  before_.reset();
  for (const Samples& samples : held_) {
    if (stop_.stop_requested()) cut_short_ = true;
    if (cut_short_) break;
    observer_.OnSamples(samples);
  }
  if (cut_short_) samples_.values.clear();  // They would follow a hole.
  held_.clear();
}

void Sampler::TakeBack() {
  assert(before_);
  Restore(*std::exchange(before_, std::nullopt));
  held_.clear();
}

}  // namespace contact
