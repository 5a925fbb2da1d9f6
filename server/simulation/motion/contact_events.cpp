#include "simulation/motion/contact_events.h"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>

namespace contact {
namespace {

constexpr int kPieces = 8;
// A deformation that so many times its noise begins in a step is no start from rest, which would
// have begun in the step before: by chance that one ended on the touch.
constexpr double kFast = 100;
// Part of a step in which bodies that separate are apart at last.
constexpr double kSoonest = 1e-9;
// Part of the largest stretch by which a peak that passes it is round-off, as where a spring has
// just stuck: with 0 it slips there without end (SlippingSpring.DissipatesWhatALoadDoes); with more
// a slip is missed that is longer (FirstSlip.IsFoundWhere…).
constexpr double kGraze = 1e-12;

// Root of f between a and b, where it changes sign; a when it already has b's sign there.
template <class F>
double Root(F f, double a, double b) {
  const double fa = f(a), fb = f(b);
  if (fa == 0 || (fa > 0) == (fb > 0)) return a;
  if (fb == 0) return b;
  std::uintmax_t iterations = 100;
  const auto bracket = boost::math::tools::toms748_solve(
      f, a, b, fa, fb, boost::math::tools::eps_tolerance<double>(52), iterations);
  return (bracket.first + bracket.second) / 2;
}

// First θ after `from` at which f, looked at after every eighth of the rest, is positive;
// `at_end` is f(1).
template <class F>
std::optional<double> FirstPositive(F f, double at_end, double from = 0) {
  double before = from;
  for (int i = 1; i <= kPieces; ++i) {
    const double theta = from + (1 - from) * i / kPieces;
    if ((i == kPieces ? at_end : f(theta)) > 0) return Root(f, before, i == kPieces ? 1 : theta);
    before = theta;
  }
  return std::nullopt;
}

// A θ in the first eighth of a step at which δ is below a level; 0: none was found.
double EarlyBelow(const DeformationPath& path, double level) {
  for (double theta = 1.0 / kPieces; theta > kSoonest; theta /= 4) {
    if (path.Value(theta) < level) return theta;
  }
  return 0;
}

// Where touching bodies that are closer at the end of the step begin to close: at once, or, if they
// part first, however early, where they come back to the deformation at which they began.
double StartOfClosing(const DeformationPath& path) {
  const double level = std::max(0.0, path.start.value);
  const auto above = [&](double theta) { return path.Value(theta) - level; };
  for (int i = kPieces - 1; i > 0; --i) {
    const double theta = static_cast<double>(i) / kPieces;
    if (above(theta) <= 0) return Root(above, theta, static_cast<double>(i + 1) / kPieces);
  }
  const double parted = path.start.curvature < 0 ? EarlyBelow(path, level) : 0;
  return parted > 0 ? Root(above, parted, 4 * parted) : 0;
}

// From where on bodies that move apart are apart: round-off may leave a trace of deformation at the
// start, which they may leave and come back to early in the step.
double StartOfFlight(const DeformationPath& path) {
  return path.start.value < 0 || path.drift >= 0 ? 0 : EarlyBelow(path, 0);
}

std::optional<ContactEvent> FirstTouch(const DeformationPath& path, double noise) {
  // What plainly moves apart is not at rest; it may come back in the step.
  if (std::abs(path.start.value) <= noise && path.drift >= -noise && path.drift <= kFast * noise) {
    if (path.end.value <= noise) return std::nullopt;
    const double theta = StartOfClosing(path);
    const bool at_rest = path.Slope(theta) <= kFast * noise;
    return ContactEvent{at_rest ? EventKind::kRestTouch : EventKind::kTouch, theta};
  }
  if (path.start.value > 0 && path.drift > 0) return ContactEvent{EventKind::kTouch, 0};  // A tie.
  const bool peaks = path.start.slope > 0 && path.end.slope < 0;
  if (path.end.value <= noise && !peaks) return std::nullopt;
  const auto value = [&](double theta) { return path.Value(theta); };
  if (auto theta = FirstPositive(value, path.end.value, StartOfFlight(path))) {
    return ContactEvent{EventKind::kTouch, *theta};
  }
  const auto falling = [&](double theta) { return -path.Slope(theta); };
  const auto peak = FirstPositive(falling, -path.end.slope);
  if (!peak || path.Value(*peak) <= noise) return std::nullopt;
  return ContactEvent{EventKind::kTouch, Root(value, 0, *peak)};
}

// First θ at which the path falls, in the direction of `sign`. At the end of a step that is warped
// to it the slope is 0, whatever the rate, so that is looked at just before.
std::optional<double> FirstFall(const DeformationPath& path, int sign) {
  const double last = path.end.slope == 0 ? 1 - 1e-6 : 1;
  const auto falling = [&](double part) { return -sign * path.Slope(part * last); };
  const auto part = FirstPositive(falling, falling(1));
  return part ? std::optional(*part * last) : std::nullopt;
}

}  // namespace

DeformationPath::DeformationPath(End from, End to, double drift_of_step)
    : start(from), end(to), drift(drift_of_step) {
  c_[0] = start.value;
  c_[1] = start.slope;
  c_[2] = start.curvature / 2;
  // What the cubic start leaves to the end, spread over θ³, θ⁴, θ⁵.
  const double value = end.value - c_[0] - c_[1] - c_[2];
  const double slope = end.slope - c_[1] - 2 * c_[2];
  const double curvature = end.curvature - 2 * c_[2];
  c_[3] = 10 * value - 4 * slope + curvature / 2;
  c_[4] = -15 * value + 7 * slope - curvature;
  c_[5] = 6 * value - 3 * slope + curvature / 2;
}

double DeformationPath::Value(double t) const {
  return c_[0] + t * (c_[1] + t * (c_[2] + t * (c_[3] + t * (c_[4] + t * c_[5]))));
}

double DeformationPath::Slope(double t) const {
  return c_[1] + t * (2 * c_[2] + t * (3 * c_[3] + t * (4 * c_[4] + t * 5 * c_[5])));
}

std::optional<ContactEvent> FirstEvent(Phase phase, const DeformationPath& path, double from,
                                       double noise) {
  if (phase == Phase::kOpen) return FirstTouch(path, noise);
  if (phase == Phase::kStarting) return std::nullopt;
  const auto first = [&](EventKind kind, auto f, double at_end) -> std::optional<ContactEvent> {
    const auto theta = FirstPositive(f, at_end, from);
    if (!theta) return std::nullopt;
    return ContactEvent{kind, *theta};
  };
  const auto rising = [&](double theta) { return path.Slope(theta); };
  const auto falling = [&](double theta) { return -path.Slope(theta); };
  const auto outside = [&](double theta) { return -path.Value(theta); };
  if (phase == Phase::kCompression) return first(EventKind::kTurn, falling, -path.end.slope);
  const auto separation = first(EventKind::kSeparation, outside, -path.end.value);
  if (phase == Phase::kResting) return separation;
  const auto rest = first(EventKind::kNonSeparation, rising, path.end.slope);
  return separation && (!rest || separation->theta <= rest->theta) ? separation : rest;
}

std::optional<ContactEvent> FirstSlip(const DeformationPath& path, double most, int side) {
  if (side != 0) {
    const auto turn = FirstFall(path, side);
    return turn ? std::optional(ContactEvent{EventKind::kStick, *turn}) : std::nullopt;
  }
  for (const int sign : {1, -1}) {
    const auto beyond = [&](double theta) { return sign * path.Value(theta) - most; };
    const double at_end = beyond(1);
    if (at_end <= 0 && sign * path.end.slope > 0) continue;
    auto theta = FirstPositive(beyond, at_end);
    if (!theta) {
      const auto peak = FirstFall(path, sign);
      if (peak && beyond(*peak) > kGraze * most) theta = Root(beyond, 0, *peak);
    }
    if (theta) return ContactEvent{EventKind::kSlip, *theta};
  }
  return std::nullopt;
}

}  // namespace contact
