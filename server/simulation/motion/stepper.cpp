#include "simulation/motion/stepper.h"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>

#include "simulation/model/contact_spring.h"
#include "simulation/model/index.h"

namespace contact {
namespace {

constexpr int kMaxRejections = 60;
constexpr int kMaxLandings = 8;
// A step that would go this far towards a separation goes for it,
constexpr double kReach = 0.85;
// but only from a deformation this small against the largest of the cycle, at a tolerance of 1,
constexpr double kNear = 0.7;
// and else at most so far towards it.
constexpr double kApproach = 0.8;
constexpr double kTrapezoid = 0.1;
constexpr double kSafety = 0.8;  // Of the next step.
constexpr double kEarly = 10;    // Tolerances a step may miss by in a pass that is not exact.
constexpr double kMostGrowth = 6;
constexpr double kStable = 4;  // λ h of the first explicit step after implicit ones.
// The scale of a contact, in that of the largest: with 1e-3 the ε of weak contacts was off by 3e-6.
constexpr double kWeakest = 1e-3;
// Round-off of what a step sums.
constexpr double kRoundOff = 1e-15;
// A contact at rest sleeps once its swing is this part of what it was when the rest began, and has
// this part of its deformation as scale: round-off of forces makes of three balls that lie on each
// other a swing of 1e-16 m/s, to follow which takes 1,200 steps a second. Always, and with the
// whole deformation, ends of cycles after a rest of clamped rods are off by 2e-7; with a tenth of
// this part three balls take 1,100 steps a second. Rest.CostsNothingOnceItSleeps.
constexpr double kAsleep = 1e-8, kOfRest = 0.01;
// Part of the acceleration of a contact below which its own force is faint, where it is largest.
constexpr double kFaint = 0.1;
// Part of a step that is left of one in which a collision would begin and turn; not below this part
// of its duration.
constexpr double kPart = 0.25, kShortest = 1e-9;
constexpr double kForever = std::numeric_limits<double>::infinity();

// By value, which std::max is not: it makes branches of what is one instruction.
double Largest(double a, double b) { return a < b ? b : a; }
double Largest(double a, double b, std::same_as<double> auto... more) {
  return Largest(Largest(a, b), more...);
}

template <class Count>
double LargestOf(Count n, const double* values) {
  double largest = 0;
  for (std::ptrdiff_t i = 0; i < n; ++i) largest = Largest(largest, std::abs(values[i]));
  return largest;
}

// A length and a speed that belong together.
struct Motions {
  double length = 0, speed = 0;
};

// The square of what both estimates of an error make, e5²/√(e5² + 0.01 e3²), each taken of length
// and speed together, for either alone passes through 0 at times.
double Square(const Motions& e5, const Motions& e3, const Motions& scale) {
  if (!(scale.length > 0 && scale.speed > 0)) return 0;
  const double per_length = 1 / scale.length, per_speed = 1 / scale.speed;
  const auto sum = [&](const Motions& e) {
    const double x = e.length * per_length, v = e.speed * per_speed;
    return x * x + v * v;
  };
  const double five = sum(e5);
  const double both = five == 0 ? 0 : five * five / (five + 0.01 * sum(e3));
  return std::isnan(both) ? kForever : both;  // No finite error that follows may hide it.
}

}  // namespace

Stepper::Stepper(MovingSystem& system)
    : system_(system),
      shifts_(system.fixed_step() == 0 && !IsPacking(system.scenario)),
      error5_(2 * system.scenario.bodies.size()),
      error3_(2 * system.scenario.bodies.size()) {}

void Stepper::Begin() {
  flight_length_ = flight_speed_ = 0;
  // What round-off of a stretched spring's force makes of bodies that stand still is no motion.
  const double digits = kRoundOff / system_.finest;
  for (std::size_t i = 0; i < system_.scenario.supports.size(); ++i) {
    const Support& s = system_.scenario.supports[i];
    const Sides sides = system_.equations.SidesOf(s.body, s.other);
    const double stretch = system_.equations.Stretch(i, system_.rk.y0.data());
    const double stiffness = std::abs(system_.equations.SpringOf(i, stretch).slope);
    const double rate = std::sqrt(stiffness * (sides.left_inverse + sides.right_inverse));
    const double length = digits * std::abs(stretch);
    flight_length_ = std::max(flight_length_, length);
    flight_speed_ = std::max(flight_speed_, length * rate);
  }
  cruise_ = 0;
  choice_.Begin();
}

void Stepper::Widen() {
  const int n = system_.equations.bodies();
  if (system_.equations.active.empty()) {
    flight_length_ = std::max(flight_length_, system_.rk.y0.head(n).abs().maxCoeff());
    flight_speed_ = std::max(flight_speed_, system_.rk.y0.segment(n, n).abs().maxCoeff());
  }
  for (const ActiveContact& active : system_.equations.active) {
    const auto c = At(active.contact);
    const double moved = system_.Deformation(active.contact, system_.rk.y0.data()) -
                         system_.contacts[c].cycle.start_deformation;
    system_.scales[c].length = std::max(system_.scales[c].length, std::abs(moved));
    system_.scales[c].speed =
        std::max(system_.scales[c].speed,
                 std::abs(system_.equations.Relative(active.contact, system_.rk.y0.data() + n)));
  }
}

void Stepper::Separated() {
  if (shifts_) system_.next_step = std::max(system_.next_step, cruise_);
}

// How a step is warped: evenly in √(t − t_s) after a touch, or in √(t_o − t) before a separation,
// whichever is nearer, for force grows and fades with a fractional power of these times.
double Stepper::Warp(double h, double parting) const {
  if (system_.fixed_step() > 0) return 1;
  const auto warp = [](double start, double end) {
    return 2 * std::sqrt(start) / (std::sqrt(start) + std::sqrt(end));
  };
  const double since = system_.time - system_.touch_time;
  const double after = std::isnan(since) ? 1 : warp(since, since + h);
  const double before = parting < kForever ? warp(parting, std::max(0.0, parting - h)) : 1;
  return before - 1 > 1 - after ? before : after;
}

// When a contact in restitution will part; infinite if it seems it will not. By the parabola
// through δ, δ̇ and the mean δ̈, in which F fades like (1 − θ)^1.5 and all else stays.
double Stepper::TimeToSeparation(const ActiveContact& active) const {
  constexpr double kFade = 3.0 / 7;  // 1 − 2 ∫(1 − θ)^2.5 dθ
  const int n = system_.equations.bodies();
  const double deformation = active.Relative(system_.rk.y0.data()) - active.gap;
  const double speed = -active.Relative(system_.rk.y0.data() + n);
  const double force = active.At(deformation, -speed).force;
  const double bend = active.Relative(system_.rk.slope0.data() + n) +
                      kFade * force * (active.left_inverse + active.right_inverse);
  const double discriminant = speed * speed - 2 * deformation * bend;
  if (speed <= 0 || deformation <= 0 || discriminant < 0) return kForever;
  return 2 * deformation / (speed + std::sqrt(discriminant));
}

StepTime Stepper::Plan(double until) {
  const double left = std::min(until, system_.breakpoint) - system_.time;
  double h = std::min({system_.next_step, left, 0.5 * system_.forcing_time});
  if (left - h < 1e-3 * h) h = left;  // Leave no sliver.
  separating_ = kNone;
  if (choice_.implicit()) return {.start = system_.time, .h = h};
  double parting = kForever;
  const ActiveContact* first = nullptr;
  for (const ActiveContact& active : system_.equations.active) {
    if (system_.contacts[At(active.contact)].phase != Phase::kRestitution) continue;
    const double time = TimeToSeparation(active);
    if (time < parting) parting = time, first = &active;
  }
  if (parting > 2 * h) cruise_ = h;
  if (parting * kReach <= h && parting <= left) {
    const double deformation = first->Relative(system_.rk.y0.data()) - first->gap;
    const double near = kNear * std::pow(system_.tolerance, 1.0 / 7);
    if (deformation <= near * system_.scales[At(first->contact)].length) {
      separating_ = first->contact;
      return {.start = system_.time, .h = parting, .warp = 2};
    }
    h = std::min(h, kApproach * parting);  // Too far off to know when it will part.
  }
  return {.start = system_.time, .h = h, .warp = Warp(h, parting)};
}

// The classical method's step is what it is.
void Stepper::TakeFixed(double until) {
  const double left = std::min(until, system_.breakpoint) - system_.time;
  const bool last = left < (1 + 1e-6) * system_.fixed_step();  // Leave no sliver.
  separating_ = kNone;
  Compute(last ? left : system_.fixed_step(), false);
}

bool Stepper::Take(double until) {
  until_ = until;
  const int n = system_.equations.bodies();
  if (system_.fixed_step() > 0) {
    TakeFixed(until);
    return true;
  }
  if (system_.next_step == 0) {
    const double speed = system_.rk.y0.segment(n, n).abs().maxCoeff();
    const double acceleration = system_.rk.slope0.segment(n, n).abs().maxCoeff();
    system_.next_step = speed > 0 ? 0.01 * speed / acceleration : 1e-6;  // Infinite in free flight.
  }
  const double most = MostError();
  for (int rejections = 0; rejections < kMaxRejections; ++rejections) {
    system_.step = Plan(until);
    system_.TakeStep(choice_.implicit());
    const double error = Error();
    const double growth = Growth(error);
    if (error <= most && TurnsAtOnce()) {
      GoOn(kPart * system_.step.h);
      continue;
    }
    if (error <= most) {
      system_.FinishStep();
      Adapt(growth, rejections > 0);
      return true;
    }
    const double shorter = std::isfinite(error) ? std::clamp(growth, 0.1, 0.9) : 0.1;
    // What was to end in a separation was not near enough to it yet.
    GoOn(system_.step.Offset(separating_ == kNone ? shorter : 0.6));
  }
  return false;
}

// The square of the error of a contact's work, relative to the work, to what the contact stores
// when it is pressed by `length` [m] more than at the start of its cycle, or to the energy of its
// motion, which it has yet to take up while other forces press it faster and faster. The force of a
// contact that others drive hardly shows in its motion, by which steps are measured.
double Stepper::WorkError(const ActiveContact& active, double length) const {
  if (system_.implicit) return 0;
  Motions five, three;
  const std::ptrdiff_t work = system_.equations.work(active.contact);
  system_.rk.Errors(work, 1, &five.length, &three.length);
  const double start = system_.contacts[At(active.contact)].cycle.start_deformation;
  const Contact& contact = system_.scenario.contacts[At(active.contact)];
  const double stored = ElasticEnergy(contact, start + length, active.yield) -
                        ElasticEnergy(contact, start, active.yield);
  const int n = system_.equations.bodies();
  const double speed = active.Relative(system_.rk.y1.data() + n);
  const bool speeds_up = speed > 0 && active.Relative(system_.rk.slope0.data() + n) > 0;
  const double carried =
      speeds_up ? 0.5 * speed * speed / (active.left_inverse + active.right_inverse) : 0;
  return Square(five, three, {Largest(stored, std::abs(system_.rk.y1[work]), carried), 1});
}

// Whether a collision that begins with the step also turns in it, so that nothing has measured it:
// a load may end one long before its own scales tell.
bool Stepper::TurnsAtOnce() const {
  const int n = system_.equations.bodies();
  return std::ranges::any_of(system_.equations.active, [&](const ActiveContact& active) {
    const ContactState& state = system_.contacts[At(active.contact)];
    const bool begins = state.phase == Phase::kCompression && state.start_velocity > 0 &&
                        state.cycle.start_time == system_.time;
    return begins && active.Relative(system_.rk.y1.data() + n) < 0 &&
           system_.step.h > kShortest * state.duration;
  });
}

double Stepper::MostError() const { return system_.tolerance > system_.finest ? kEarly : 1; }

double Stepper::Growth(double error) const {
  if (error == 0) return kMostGrowth;
  if (system_.implicit) return kSafety * std::pow(error, -1.0 / system_.implicit_order);
  return kSafety / std::sqrt(std::sqrt(std::sqrt(error)));
}

void Stepper::Adapt(double growth, bool repeated) {
  const StepTime& step = system_.step;
  if (!system_.implicit) choice_.AfterExplicit(decay_ * step.h);
  growth = std::clamp(growth, 0.3, repeated ? 1.0 : kMostGrowth);
  const double next =
      separating_ == kNone ? std::max(step.Next(growth), 0.1 * step.h) : step.h * growth;
  GoOn(step.h < system_.next_step ? std::max(next, system_.next_step) : next);
}

void Stepper::GoOn(double h) {
  system_.next_step = h;
  if (!system_.implicit) return;
  choice_.AfterImplicit(decay_ * h);
  if (!choice_.implicit()) system_.next_step = std::min(h, kStable / decay_);
}

double Stepper::Error() {
  const std::ptrdiff_t n = system_.equations.bodies();
  if (system_.implicit) {
    std::copy_n(system_.euler.error().data(), 2 * n, error5_.begin());
    std::ranges::fill(error3_, 0.0);
  } else {
    system_.rk.Errors(0, 2 * n, error5_.data(), error3_.data());
  }
  double error = 0;
  WithCount<1, 2, 3, 4, 5>(n, [&](auto count) { error = ErrorNorm(count, system_.step.h); });
  return error;
}

MovingSystem::Scale Stepper::ScaleOfSleep(const ActiveContact& active, double deformation) const {
  if (system_.contacts[At(active.contact)].phase != Phase::kResting) return {};
  const int n = system_.equations.bodies();
  const double inverse_mass = active.left_inverse + active.right_inverse;
  const double rate = std::sqrt(active.StiffnessAt(deformation) * inverse_mass);
  const double swing = Largest(rate * std::abs(active.Relative(system_.rk.y0.data() + n)),
                               std::abs(active.Relative(system_.rk.slope0.data() + n)));
  if (swing > kAsleep * rate * system_.scales[At(active.contact)].speed) return {};
  return {kOfRest * deformation, kOfRest * rate * deformation};
}

// The largest motions of contacts and of all bodies, by which errors are measured.
template <class Count>
Stepper::Extent Stepper::Measure(Count n, double h) const {
  const double* y = system_.rk.y1.data();
  double length = 0, speed = 0;
  for (const ActiveContact& active : system_.equations.active) {
    const auto c = At(active.contact);
    const double moved =
        active.Relative(y) - active.gap - system_.contacts[c].cycle.start_deformation;
    const double rate = std::abs(active.Relative(y + n));
    const MovingSystem::Scale sleep = ScaleOfSleep(active, active.Relative(y) - active.gap);
    length = Largest(length, system_.scales[c].length, std::abs(moved), rate * h, sleep.length);
    speed = Largest(speed, system_.scales[c].speed, rate, sleep.speed);
  }
  const double body_speed = Largest(speed, flight_speed_, LargestOf(n, y + n));
  return {length, speed, Largest(length, flight_length_, LargestOf(n, y), body_speed * h),
          body_speed};
}

// Largest local error, in units of what the tolerance allows: that of each contact relative to
// the scale of its own cycle, that of each body relative to the largest motion of all. An error of
// δ̇ that damping ends within 1/λ leaves no more than an error of δ, λ = μ δᵖ/m_e times smaller.
template <class Count>
double Stepper::ErrorNorm(Count n, double h) {
  const double* e5 = error5_.data();
  const double* e3 = error3_.data();
  double sum = 0;
  for (std::ptrdiff_t i = 0; i < 2 * n; ++i) sum += e5[i] + e3[i];
  if (!std::isfinite(sum)) return kForever;  // And only then y1 is not finite.
  const double* y = system_.rk.y1.data();
  const Extent extent = Measure(n, h);
  const double digits = kRoundOff / system_.finest;
  double norm = 0;
  decay_ = 0;
  const bool rests =
      std::ranges::all_of(system_.equations.active, [&](const ActiveContact& active) {
        return system_.contacts[At(active.contact)].phase == Phase::kResting;
      });
  for (const ActiveContact& active : system_.equations.active) {
    const MovingSystem::Scale& own = system_.scales[At(active.contact)];
    const Motions five{active.Relative(e5), active.Relative(e5 + n)};
    const Motions three{active.Relative(e3), active.Relative(e3 + n)};
    // Of a force clipped at the end, or with a corner in the step, the estimate of order 3 tells
    // nothing.
    const double deformation = active.Relative(y) - active.gap;
    const bool kink = active.Clips(deformation, active.Relative(y + n)) ||
                      active.Bends(active.Relative(system_.rk.y0.data()) - active.gap, deformation);
    // What round-off of positions and velocities makes of a step is no error of the step.
    const double inverse_mass = active.left_inverse + active.right_inverse;
    const double moved = Largest(active.left_counts * std::abs(y[active.left]),
                                 active.right_counts * std::abs(y[active.right]));
    const double stiffness = active.StiffnessAt(deformation) * inverse_mass;
    const double rate = stiffness + system_.equations.SupportRate(active);
    const double own_length =
        std::abs(deformation - system_.contacts[At(active.contact)].cycle.start_deformation);
    const MovingSystem::Scale sleep = ScaleOfSleep(active, deformation);
    const double length = Largest(own.length, own_length, kWeakest * extent.length,
                                  digits * (moved + extent.body_speed * h), sleep.length);
    const double speed = Largest(own.speed, std::abs(active.Relative(y + n)),
                                 kWeakest * extent.speed, digits * moved * rate * h, sleep.speed);
    const double decay = kink ? 0 : active.DampingAt(deformation) * inverse_mass;
    const Motions scale{length, speed + decay * length};
    norm = Largest(norm, Square(five, kink ? Motions{} : three, scale));
    const double faint = kFaint * std::abs(active.Relative(system_.rk.slope0.data() + n));
    // Mostly what is known already tells that the contact is not faint, without another power.
    const bool strong = length >= deformation && stiffness * length >= faint;
    if (own.length > 0 && !strong && active.StiffnessAt(length) * inverse_mass * length < faint) {
      norm = Largest(norm, WorkError(active, length));
    }
    // Where all rests the swing of a contact keeps explicit steps short, as damping does.
    decay_ = Largest(decay_, decay, rests ? std::sqrt(stiffness) : 0);
  }
  const double of_bodies =
      Square({LargestOf(n, e5), LargestOf(n, e5 + n)}, {LargestOf(n, e3), LargestOf(n, e3 + n)},
             {extent.body_length, extent.body_speed});
  return h * std::sqrt(Largest(norm, of_bodies)) / system_.tolerance;
}

// Makes the step end on the event: Newton on its length with the true solution, started from the
// interpolated one, until the event's time is good to round-off. False if a predicted separation is
// not there after all; the step is then one like others.
bool Stepper::Land(const StepEvents::Found& found) {
  const bool parting = found.event.kind == EventKind::kSeparation;
  const StepTime planned = system_.step;
  const double left = std::min(until_, system_.breakpoint) - system_.time;
  // What the trapezoidal rule leaves is of third order in time.
  const bool shifts = shifts_ && !system_.implicit && found.support == kNone;
  const double nearby =
      shifts ? kTrapezoid * std::cbrt(system_.tolerance) * (system_.time - system_.touch_time) : 0;
  const double event = system_.step.Offset(found.event.theta);
  if (found.support == kNone && separating_ == found.contact && system_.step.h - event <= nearby) {
    if (found.event.theta < 1) Shift(event - system_.step.h, false);
  } else if (found.event.theta < 1) {
    Compute(event, parting);
  }
  double least = kForever, nearest = 0;
  for (int i = 0; i < kMaxLandings; ++i) {
    const Residual residual = ResidualOf(found);
    const double correction = -residual.value / residual.slope;
    const double h = system_.step.h + correction;
    if (!(h > 0) || h > 2 * planned.h) break;
    if (h > left) {  // The event is past the end, or past a breakpoint, after which all differs.
      Compute(left, planned.warp == 2);
      return false;
    }
    // So near that the tangent leads there: its error is of second order. What is within round-off
    // of time is there, too: where the step before has ended next to the event, this one is so
    // short that round-off of δ is more than 1e-7 of it.
    // Machines.SeparateAtOnceWhereAStepEndsBeside.
    const double near = std::max(1e-7 * system_.step.h, kRoundOff * system_.time);
    const bool there = std::abs(correction) <= near;
    if (there || std::abs(correction) <= nearby) {
      Shift(correction, there);
      if (!there) continue;
      // The warp of a separation may do worse on a long step: a shorter one leads nearer first.
      if (system_.step.warp == planned.warp || Error() <= MostError()) return true;
      Compute(kApproach * event, false);
      return false;
    }
    // Where all is round-off, Newton's method only leads away.
    if (!parting && std::abs(residual.value) >= least) {
      Compute(nearest, false);
      break;
    }
    least = std::abs(residual.value), nearest = system_.step.h;
    Compute(h, parting);
  }
  if (!parting) return true;  // As near as it gets.
  Compute(planned.h, planned.warp == 2);
  return false;
}

// Moves the end of the step by a short time: along the tangent, or by the trapezoidal rule.
void Stepper::Shift(double time, bool tangent) {
  system_.step.h += time;
  system_.rk.y1 += time * system_.rk.slope1;
  if (!tangent) {
    slope_ = system_.rk.slope1;
    system_.FinishStep();
    system_.rk.y1 += 0.5 * time * (system_.rk.slope1 - slope_);
  }
  system_.FinishStep();
}

void Stepper::Compute(double h, bool parting) {
  const bool plain = system_.fixed_step() > 0 || system_.implicit;
  const double warp = parting ? 2 : Warp(h);
  system_.step = {.start = system_.time, .h = h, .warp = plain ? 1 : warp};
  system_.TakeStep(system_.implicit);
  system_.FinishStep();
}

// At the end of the step.
Stepper::Residual Stepper::ResidualOf(const StepEvents::Found& found) const {
  const int n = system_.equations.bodies();
  if (found.support != kNone) return SlipResidual(found);
  const double rate = system_.equations.Relative(found.contact, system_.rk.y1.data() + n);
  switch (found.event.kind) {
    case EventKind::kRestTouch:
      return {0, 1};  // Known to within the noise.
    case EventKind::kTurn:
    case EventKind::kNonSeparation:
      return {rate, system_.equations.Relative(found.contact, system_.rk.slope1.data() + n)};
    default:
      return {system_.Deformation(found.contact, system_.rk.y1.data()), rate};
  }
}

Stepper::Residual Stepper::SlipResidual(const StepEvents::Found& found) const {
  const Support& support = system_.scenario.supports[At(found.support)];
  const Sides sides = system_.equations.SidesOf(support.body, support.other);
  const double* y = system_.rk.y1.data();
  const int n = system_.equations.bodies();
  const double rate = sides.Relative(y + n);
  if (found.event.kind == EventKind::kStick) {
    return {rate, sides.Relative(system_.rk.slope1.data() + n)};
  }
  const double stretch = system_.equations.Stretch(At(found.support), y);
  return {stretch - std::copysign(support.slip_force / support.stiffness, stretch), rate};
}

}  // namespace contact
