#include "simulation/sampler.h"

#include <algorithm>
#include <cassert>
#include <cmath>
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
}

void Sampler::OnStep(const StepTime& step) {
  if (scenario_.sample_interval == 0) return;
  bool prepared = false;
  while (true) {
    const double sample_time = static_cast<double>(next_) * scenario_.sample_interval;
    // The last sample is the end of the run, though the multiple of the interval may miss it.
    const double late = step.At(1) + 1e-9 * scenario_.sample_interval;
    if (sample_time > late || sample_time > scenario_.end_time * (1 + 1e-12)) return;
    // A step may have millions of samples. Looked at once a chunk.
    if (samples_.rows() == 0 && stop_.stop_requested()) {
      cut_short_ = true;
      return;
    }
    if (!prepared) motion_.PrepareInterpolation();
    prepared = true;
    motion_.integrator().Interpolate(std::clamp(step.Theta(sample_time), 0.0, 1.0), &y_);
    Record(std::min(sample_time, scenario_.end_time), y_);
  }
}

void Sampler::Record(double time, const Eigen::ArrayXd& y) {
  const Equations& equations = motion_.equations();
  const int n = equations.bodies();
  slope_.resize(y.size());
  equations(time, y.data(), slope_.data());
  auto& row = samples_.values;
  row.push_back(time);
  for (int i = 0; i < n; ++i) {
    row.push_back(equations.base[static_cast<std::size_t>(i)] + y[i]);
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
  if (samples_.rows() == kSamplesPerChunk) Flush();
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

Samples Sampler::pending() const {
  Samples pending = samples_;
  pending.first = next_ - samples_.rows();
  return pending;
}

void Sampler::Restore(Samples pending) {
  next_ = pending.first + pending.rows();
  samples_ = std::move(pending);
}

void Sampler::Hold() { before_ = pending(); }

void Sampler::Release() {
  before_.reset();
  for (const Samples& samples : held_) observer_.OnSamples(samples);
  held_.clear();
}

void Sampler::TakeBack() {
  assert(before_);
  Restore(*std::exchange(before_, std::nullopt));
  held_.clear();
}

}  // namespace contact
