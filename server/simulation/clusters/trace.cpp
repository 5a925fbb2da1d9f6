#include "simulation/clusters/trace.h"

#include <algorithm>
#include <cmath>

namespace contact {

std::size_t Trace::StepAt(double instant) const {
  const auto later = std::ranges::upper_bound(steps, instant, {}, &StepTime::start);
  return later == steps.begin() ? 0 : static_cast<std::size_t>(later - steps.begin()) - 1;
}

Place Trace::At(std::size_t body, std::size_t step, double instant) const {
  const StepTime& time = steps[step];
  const Ends& e = ends[step * bodies + body];
  if (instant <= time.start) return e.from;
  if (instant >= time.At(1)) return e.to;
  const double bend = 2 * time.h * (1 - time.warp);  // d²t/dθ²
  const auto end = [&](const Place& place, double acceleration, double theta) {
    const double pace = time.h * time.Rate(theta);
    return DeformationPath::End{place.u - e.from.u, pace * place.v,
                                pace * pace * acceleration + bend * place.v};
  };
  const DeformationPath path(end(e.from, e.from_acceleration, 0), end(e.to, e.to_acceleration, 1));
  const double theta = time.Theta(instant);
  const double pace = time.h * time.Rate(theta);
  return {e.from.u + path.Value(theta), pace > 0 ? path.Slope(theta) / pace : e.from.v};
}

double Trace::WorkAt(std::size_t step, double instant) const {
  const StepTime& time = steps[step];
  const Exchange& e = exchanged[step];
  if (instant >= time.At(1)) return e.work;
  const double from = step == 0 ? 0 : exchanged[step - 1].work, done = e.work - from;
  const double first = time.h * time.Rate(0) * e.from_power;
  const double last = time.h * time.Rate(1) * e.to_power;
  const double theta = time.Theta(instant);
  return from + theta * (first +
                         theta * (3 * done - 2 * first - last + theta * (first + last - 2 * done)));
}

std::span<const Trace::Pressed> Trace::PressedIn(std::size_t step) const {
  if (presses.empty()) return {};
  const std::size_t from = step == 0 ? 0 : presses[step - 1];
  return std::span(pressed).subspan(from, presses[step] - from);
}

TraceWriter::TraceWriter(const Scenario& whole, Motion& motion, const std::vector<int>& bodies,
                         const std::vector<int>& contacts, Trace* trace)
    : motion_(motion),
      contacts_(contacts),
      whole_(whole),
      trace_(*trace),
      turn_finder_(whole, motion, bodies, contacts) {}

void TraceWriter::Begin(const std::vector<Place>& places) {
  base_.clear();
  for (const Place& place : places) base_.push_back(place.u);
  trace_.bodies = places.size();
}

void TraceWriter::FindParts(const StepTime& step) {
  parts_.clear();
  const double interval = whole_.sample_interval;
  if (interval == 0) return;
  FindCycleSamples(whole_, motion_, step, &found_);
  trace_.samples.insert(trace_.samples.end(), found_.begin(), found_.end());
  turn_finder_.Find(step, base_, &turns_);
  trace_.turns.insert(trace_.turns.end(), turns_.begin(), turns_.end());
  const auto add = [&](double instant) {
    const double theta = step.Theta(instant);
    if (instant > step.start && theta > 0 && theta < 1) parts_.push_back(theta);
  };
  for (const CycleSample& sample : found_) add(sample.time);
  for (const Turn& turn : turns_) add(turn.time);
  for (double i = std::ceil(step.start / interval); i * interval < step.At(1); ++i) {
    add(i * interval);
  }
  std::ranges::sort(parts_);
}

// The clock of a step from θ₀ to θ₁ is a quadratic again: t' = h' φ (w' + (1 − w') φ).
void TraceWriter::OnStep(const StepTime& step) {
  const RungeKutta& rk = motion_.integrator();
  FindParts(step);
  if (trace_.steps.empty()) lost_before_ = motion_.ExchangedUntil(rk.y0).dissipated;
  if (parts_.empty()) return Write(step, rk.y0, rk.slope0, rk.y1, rk.slope1);
  motion_.PrepareInterpolation();
  from_ = rk.y0;
  from_slope_ = rk.slope0;
  to_slope_.resize(rk.y0.size());
  double last = 0;
  const auto write_to = [&](double theta) {
    StepTime part{.start = step.At(last), .h = step.Offset(theta) - step.Offset(last)};
    if (part.h <= 0) return;
    part.warp = step.h * step.Rate(last) * (theta - last) / part.h;
    Write(part, from_, from_slope_, to_, to_slope_);
    last = theta;
    from_.swap(to_);
    from_slope_.swap(to_slope_);
  };
  for (const double theta : parts_) {
    motion_.Interpolate(theta, &to_);
    motion_.equations()(step.At(theta), to_.data(), to_slope_.data());
    write_to(theta);
  }
  to_ = rk.y1;
  to_slope_ = rk.slope1;
  write_to(1);
}

void TraceWriter::Write(const StepTime& step, const Eigen::ArrayXd& y0,
                        const Eigen::ArrayXd& slope0, const Eigen::ArrayXd& y1,
                        const Eigen::ArrayXd& slope1) {
  const auto n = static_cast<std::ptrdiff_t>(motion_.equations().bodies());
  trace_.steps.push_back(step);
  for (std::size_t b = 0; b < trace_.bodies; ++b) {
    const auto i = static_cast<std::ptrdiff_t>(b);
    trace_.ends.push_back({.from = {base_[b] + y0[i], y0[n + i]},
                           .to = {base_[b] + y1[i], y1[n + i]},
                           .from_acceleration = slope0[n + i],
                           .to_acceleration = slope1[n + i]});
  }
  if (whole_.sample_interval == 0) return;
  const Exchanged until = motion_.ExchangedUntil(y1);
  const auto work = motion_.equations().load_work();
  trace_.exchanged.push_back({.dissipated = until.dissipated - lost_before_,
                              .work = until.load_work,
                              .from_power = slope0[work],
                              .to_power = slope1[work]});
  for (const ActiveContact& active : motion_.equations().active) {
    const int contact = contacts_[static_cast<std::size_t>(active.contact)];
    trace_.pressed.push_back({contact, active.mu, active.yield});
  }
  trace_.presses.push_back(trace_.pressed.size());
}

void TraceWriter::Hold() {
  held_ = trace_.steps.size();
  held_samples_ = trace_.samples.size();
  held_turns_ = trace_.turns.size();
}

void TraceWriter::TakeBack() {
  trace_.steps.resize(held_);
  trace_.ends.resize(held_ * trace_.bodies);
  if (whole_.sample_interval == 0) return;
  trace_.samples.resize(held_samples_);
  trace_.turns.resize(held_turns_);
  trace_.exchanged.resize(held_);
  trace_.presses.resize(held_);
  trace_.pressed.resize(held_ == 0 ? 0 : trace_.presses.back());
}

}  // namespace contact
