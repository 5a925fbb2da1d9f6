#include "simulation/course/turns.h"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "simulation/model/index.h"

namespace contact {
namespace {

// A rate that is so small a part of that at the other end of the step is 0 but for round-off: a
// step that lands on an event ends with δ̇ or F of 1e-16 of what they were, of either sign
// (Turns.InClustersAreThoseOfTheWhole).
constexpr double kNothing = 1e-9;

}  // namespace

TurnFinder::TurnFinder(const Scenario& whole, Motion& motion, const std::vector<int>& bodies,
                       const std::vector<int>& contacts)
    : whole_(whole), motion_(motion), bodies_(bodies), contacts_(contacts) {}

void TurnFinder::Find(const StepTime& step, std::span<const double> base,
                      std::vector<Turn>* found) {
  found->clear();
  if (whole_.turning_channels == 0) return;
  step_ = step;
  prepared_ = false;
  found_ = found;
  for (const ActiveContact& active : motion_.equations().active) FindForce(active);
  if (whole_.turning_channels > std::ssize(whole_.contacts)) {
    for (std::size_t i = 0; i < base.size(); ++i) FindBody(static_cast<std::ptrdiff_t>(i), base[i]);
  }
  std::ranges::stable_sort(*found, {}, &Turn::time);
}

void TurnFinder::FindForce(const ActiveContact& active) {
  const std::ptrdiff_t n = motion_.equations().bodies();
  const int channel = contacts_[At(active.contact)];
  const auto force = [&](const Eigen::ArrayXd& y) {
    const double rate = active.Relative(y.data() + n);
    return active.At(motion_.Deformation(active.contact, y.data()), rate).force;
  };
  if (motion_.contacts()[At(active.contact)].cycle.start_time >= step_.start) {
    Add(0, channel, force);
  }
  AddZero([&](const auto& y, const auto& slope) { return Growth(active, y, slope); }, channel,
          force);
}

double TurnFinder::Growth(const ActiveContact& active, const Eigen::ArrayXd& y,
                          const Eigen::ArrayXd& slope) const {
  const std::ptrdiff_t n = motion_.equations().bodies();
  const double rate = active.Relative(y.data() + n);
  const auto force = active.At(motion_.Deformation(active.contact, y.data()), rate);
  return force.by_deformation * rate + force.by_rate * active.Relative(slope.data() + n);
}

void TurnFinder::FindBody(std::ptrdiff_t body, double base) {
  const std::ptrdiff_t n = motion_.equations().bodies();
  const int place = static_cast<int>(whole_.contacts.size()) + 2 * bodies_[At(body)];
  const auto velocity = [&](const auto& y) { return y[n + body]; };
  AddZero([&](const auto& y, const auto&) { return y[n + body]; }, place,
          [&](const auto& y) { return base + y[body]; });
  AddZero([&](const auto&, const auto& slope) { return slope[n + body]; }, place + 1, velocity);
  // Between two contacts without a load v is constant.
  for (const ActiveContact& active : motion_.equations().active) {
    const bool is_side = (active.left_counts > 0 && active.left == body) ||
                         (active.right_counts > 0 && active.right == body);
    const double start = motion_.contacts()[At(active.contact)].cycle.start_time;
    if (is_side && start >= step_.start) return Add(0, place + 1, velocity);
  }
}

template <class Value>
void TurnFinder::Add(double theta, int channel, const Value& value) {
  GoTo(theta);
  found_->push_back({.time = step_.At(theta), .channel = channel, .value = value(y_)});
}

template <class Rate, class Value>
void TurnFinder::AddZero(const Rate& rate, int channel, const Value& value) {
  const RungeKutta& rk = motion_.integrator();
  const double from = rate(rk.y0, rk.slope0), to = rate(rk.y1, rk.slope1);
  if (std::abs(from) <= kNothing * std::abs(to)) return;
  if (std::abs(to) <= kNothing * std::abs(from)) return Add(1, channel, value);
  if (from * to > 0) return;
  const auto at = [&](double theta) {
    GoTo(theta);
    slope_.resize(y_.size());
    motion_.equations()(step_.At(theta), y_.data(), slope_.data());
    return rate(y_, slope_);
  };
  // θ to a thousandth: the extreme to 1e-6 of what the channel changes in the step.
  const boost::math::tools::eps_tolerance<double> tolerance(10);
  std::uintmax_t most = 10;
  const auto [low, high] =
      boost::math::tools::toms748_solve(at, 0.0, 1.0, from, to, tolerance, most);
  Add((low + high) / 2, channel, value);
}

void TurnFinder::GoTo(double theta) {
  if (!prepared_) motion_.PrepareInterpolation();
  prepared_ = true;
  motion_.Interpolate(theta, &y_);
}

}  // namespace contact
