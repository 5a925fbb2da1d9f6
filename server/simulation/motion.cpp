#include "simulation/motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace contact {
namespace {

constexpr int kMaxRejections = 60;
constexpr int kMaxLandings = 8;
// A step that would come this near to a separation goes for it.
constexpr double kReach = 0.7;
// But only from a deformation this small against the largest of the cycle.
constexpr double kNear = 0.02;
constexpr int kMaxCyclesInStretch = 64;
constexpr int kMaxEventsAtOnce = 1000;

std::size_t At(int index) { return static_cast<std::size_t>(index); }

bool IsRunning(const ContactState& c) {
  return c.phase == Phase::kCompression || c.phase == Phase::kRestitution;
}

bool IsStarting(const ContactState& c) { return c.phase == Phase::kStarting; }

}  // namespace

bool InCycle(const State& state) {
  return std::any_of(state.contacts.begin(), state.contacts.end(), [](const ContactState& c) {
    return IsRunning(c) || (IsStarting(c) && !c.settled);
  });
}

State InitialState(const Scenario& scenario) {
  State state;
  for (const Body& body : scenario.bodies) {
    state.positions.push_back(body.position);
    state.velocities.push_back(body.velocity);
  }
  for (const Contact& c : scenario.contacts) {
    const Body* left = c.left == kNone ? nullptr : &scenario.bodies[At(c.left)];
    const Body* right = c.right == kNone ? nullptr : &scenario.bodies[At(c.right)];
    const double left_face = left ? left->position + left->radius : c.wall_position;
    const double right_face = right ? right->position - right->radius : c.wall_position;
    ContactState contact;
    contact.gap = right_face - left_face;
    // What decimal input leaves of a gap of zero is no gap.
    const double size = std::max(std::abs(left_face), std::abs(right_face)) +
                        (left ? left->radius : 0) + (right ? right->radius : 0);
    if (std::abs(contact.gap) <= 1e-12 * size) contact.gap = 0;
    const double rate = (left ? left->velocity : 0) - (right ? right->velocity : 0);
    if (contact.gap <= 0 && rate > 0) {
      contact.phase = Phase::kStarting;
      contact.cycle.kind = Cycle::Kind::kCollision;
    }
    contact.cycle.contact = static_cast<int>(state.contacts.size());
    state.contacts.push_back(contact);
  }
  return state;
}

Motion::Motion(const Scenario& scenario)
    : scenario_(scenario),
      equations_(scenario),
      deformation_scale_(scenario.contacts.size()),
      velocity_scale_(scenario.contacts.size()),
      start_gradient_(scenario.contacts.size()),
      turn_gradient_(scenario.contacts.size()),
      error5_(2 * scenario.bodies.size()),
      error3_(2 * scenario.bodies.size()),
      forcing_time_(equations_.ForcingTime()),
      event_(scenario.contacts.size()) {}

void Motion::Begin(const State& state, bool recording) {
  const int n = equations_.bodies();
  time_ = state.time;
  next_step_ = state.step;
  contacts_ = state.contacts;
  totals_ = State{};
  totals_.load_work = state.load_work;
  totals_.support_loss = state.support_loss;
  totals_.impulse = state.impulse;
  contact_loss_ = state.contact_loss;
  cycles_in_stretch_ = 0;
  flight_length_ = flight_speed_ = 0;
  touch_time_ = kNaN;

  equations_.base = state.positions;
  equations_.recording = recording;
  equations_.columns = 0;
  rk_.Resize(equations_.size());
  rk_.y0.setZero();
  for (int i = 0; i < n; ++i) rk_.y0[n + i] = state.velocities[At(i)];
  for (int c = 0; c < equations_.contacts(); ++c) {
    ContactState& contact = contacts_[At(c)];
    rk_.y0[2 * n + c] = contact.work;
    if (recording) rk_.y0[equations_.external_work(c)] = contact.external_work;
    start_gradient_[At(c)].resize(0);
    turn_gradient_[At(c)].resize(0);
    deformation_scale_[At(c)] = std::abs(contact.gap + contact.cycle.start_deformation);
    velocity_scale_[At(c)] = contact.cycle.approach_velocity;
    if (contact.phase == Phase::kResting) SetRestingScale(c);
  }
  RefreshActive();
}

State Motion::Save() const {
  const int n = equations_.bodies();
  State state;
  state.time = time_;
  state.step = next_step_;
  state.contacts = contacts_;
  state.positions.resize(At(n));
  state.velocities.resize(At(n));
  for (int i = 0; i < n; ++i) {
    state.positions[At(i)] = equations_.base[At(i)] + rk_.y0[i];
    state.velocities[At(i)] = rk_.y0[n + i];
  }
  for (int c = 0; c < equations_.contacts(); ++c) {
    ContactState& contact = state.contacts[At(c)];
    contact.gap = -Deformation(c, rk_.y0.data());
    contact.work = rk_.y0[2 * n + c];
    if (equations_.recording) contact.external_work = rk_.y0[equations_.external_work(c)];
  }
  state.load_work = totals_.load_work;
  state.support_loss = totals_.support_loss;
  state.impulse = totals_.impulse;
  state.contact_loss = contact_loss_;
  if (equations_.recording) {
    state.load_work += rk_.y0[equations_.load_work()];
    state.support_loss += rk_.y0[equations_.support_loss()];
    state.impulse += rk_.y0[equations_.impulse()];
  }
  return state;
}

double Motion::Deformation(int contact, const double* y) const {
  return equations_.Relative(contact, y) - contacts_[At(contact)].gap;
}

void Motion::PrepareInterpolation() {
  rk_.PrepareInterpolation(equations_, step_);
  evaluations_ += 3;
}

Motion::Pause Motion::Advance(double until, CycleHost& host, StepListener* listener,
                              const std::stop_token& stop, std::int64_t step_limit) {
  StartCycles(host, false);
  const bool busy = Busy();
  int events_at_once = 0;
  while (true) {
    if (time_ >= until) return Pause::kTimeUp;
    if (stop.stop_requested()) return Pause::kStopped;
    if (steps_ >= step_limit) return Pause::kStepLimit;
    if (!TakeStep(until)) return Pause::kNumeric;
    const Found found = PassTurns();
    const bool moves = found.contact == kNone || found.event.theta > 0;
    if (moves && found.contact != kNone) Land(found);
    if (moves) Accept(listener);
    if (found.contact != kNone) Apply(found, host);
    WakeResting(host);
    events_at_once = moves ? 0 : events_at_once + 1;
    if (events_at_once > kMaxEventsAtOnce) return Pause::kNumeric;
    StartCycles(host, !Busy());
    if (busy && !Busy()) return Pause::kQuiet;
    if (!busy && std::any_of(contacts_.begin(), contacts_.end(), IsStarting)) {
      return Pause::kCycleStarts;
    }
    if (cycles_in_stretch_ >= kMaxCyclesInStretch) return Pause::kCrowded;
  }
}

bool Motion::Busy() const { return std::any_of(contacts_.begin(), contacts_.end(), IsRunning); }

void Motion::RefreshActive() {
  equations_.active.clear();
  for (int c = 0; c < equations_.contacts(); ++c) {
    const ContactState& contact = contacts_[At(c)];
    if (!IsRunning(contact) && contact.phase != Phase::kResting) continue;
    equations_.active.push_back(
        equations_.Activate(c, contact.gap, contact.cycle.mu, contact.column));
  }
  equations_(time_, rk_.y0.data(), rk_.slope0.data());
  ++evaluations_;
}

// How a step is warped after a touch, whose force grows with a fractional power of time.
double Motion::TouchWarp(double h) const {
  if (std::isnan(touch_time_)) return 1;
  const double since = std::sqrt(time_ - touch_time_);
  return 2 * since / (since + std::sqrt(time_ - touch_time_ + h));
}

// When a contact in restitution will part; infinite if it seems it will not. By the parabola
// through δ, δ̇ and the mean δ̈, in which F fades like (1 − θ)^1.5 and all else stays.
double Motion::TimeToSeparation(const ActiveContact& active) const {
  constexpr double kFade = 3.0 / 7;  // 1 − 2 ∫(1 − θ)^2.5 dθ
  const int n = equations_.bodies();
  const double deformation = active.Relative(rk_.y0.data()) - active.gap;
  const double speed = -active.Relative(rk_.y0.data() + n);
  const double force = active.At(deformation, -speed).force;
  const double bend = active.Relative(rk_.slope0.data() + n) +
                      kFade * force * (active.left_inverse + active.right_inverse);
  const double discriminant = speed * speed - 2 * deformation * bend;
  if (speed <= 0 || deformation <= 0 || discriminant < 0) {
    return std::numeric_limits<double>::infinity();
  }
  return 2 * deformation / (speed + std::sqrt(discriminant));
}

StepTime Motion::Plan(double until) {
  const double left = until - time_;
  double h = std::min({next_step_, left, 0.5 * forcing_time_});
  if (left - h < 1e-3 * h) h = left;  // Leave no sliver.
  separating_ = kNone;
  double reach = h / kReach;
  for (const ActiveContact& active : equations_.active) {
    if (contacts_[At(active.contact)].phase != Phase::kRestitution) continue;
    const double parting = TimeToSeparation(active);
    if (parting > reach || parting > left) continue;
    const double deformation = active.Relative(rk_.y0.data()) - active.gap;
    if (deformation > kNear * deformation_scale_[At(active.contact)]) {
      h = std::min(h, 0.6 * parting);  // Too far off to know when it will part.
    } else {
      reach = parting;
      separating_ = active.contact;
    }
  }
  if (separating_ != kNone) return {.start = time_, .h = reach, .warp = 2};
  return {.start = time_, .h = h, .warp = TouchWarp(h)};
}

bool Motion::TakeStep(double until) {
  const int n = equations_.bodies();
  if (next_step_ == 0) {
    const double speed = rk_.y0.segment(n, n).abs().maxCoeff();
    const double acceleration = rk_.slope0.segment(n, n).abs().maxCoeff();
    next_step_ = speed > 0 && acceleration > 0 ? 0.01 * speed / acceleration : 1e-6;
  }
  std::fill(event_.begin(), event_.end(), 0.0);
  for (int rejections = 0; rejections < kMaxRejections; ++rejections) {
    step_ = Plan(until);
    rk_.Step(equations_, step_);
    ++steps_;
    evaluations_ += 11;
    const double error = ErrorNorm(step_.h);
    const double factor = error > 0 ? 0.9 * std::pow(error, -1.0 / 8) : 6;
    if (error <= 1) {
      rk_.FinishStep(equations_, step_);
      ++evaluations_;
      const double growth = std::clamp(factor, 0.3, rejections > 0 ? 1.0 : 6.0);
      const double next = step_.h * growth;
      next_step_ = step_.h < next_step_ ? std::max(next, next_step_) : next;
      return true;
    }
    if (separating_ != kNone) {
      next_step_ = 0.5 * step_.h;  // Not near enough yet.
    } else {
      next_step_ = step_.h * (std::isfinite(error) ? std::clamp(factor, 0.1, 0.9) : 0.1);
    }
  }
  return false;
}

// Largest local error, in units of what the tolerance allows: that of each contact relative to
// the scale of its own cycle, that of each body relative to the largest scale of all.
double Motion::ErrorNorm(double h) const {
  const int n = equations_.bodies();
  double length = 0, speed = 0;
  for (const ActiveContact& active : equations_.active) {
    const int c = active.contact;
    const double moved =
        active.Relative(rk_.y1.data()) - active.gap - contacts_[At(c)].cycle.start_deformation;
    const double rate = std::abs(active.Relative(rk_.y1.data() + n));
    length = std::max({length, deformation_scale_[At(c)], std::abs(moved), rate * h});
    speed = std::max({speed, velocity_scale_[At(c)], rate});
  }
  if (equations_.active.empty()) {
    speed = std::max(flight_speed_, rk_.y1.segment(n, n).abs().maxCoeff());
    length = std::max({flight_length_, rk_.y1.head(n).abs().maxCoeff(), speed * h});
  }
  const auto combined = [&](double e5, double e3, double scale) {
    const double denominator = e5 * e5 + 0.01 * e3 * e3;
    return denominator == 0 ? 0.0 : h * e5 * e5 / std::sqrt(denominator) / scale;
  };
  double norm = 0;
  auto& e5 = error5_;
  auto& e3 = error3_;
  for (int i = 0; i < 2 * n; ++i) {
    e5[At(i)] = rk_.Error5(i);
    e3[At(i)] = rk_.Error3(i);
    const double e = combined(e5[At(i)], e3[At(i)], i < n ? length : speed);
    if (!(e <= norm)) norm = e;  // Keeps a NaN.
  }
  for (const ActiveContact& active : equations_.active) {
    const int c = active.contact;
    const double own_length = std::max(deformation_scale_[At(c)], 1e-3 * length);
    const double own_speed = std::max(velocity_scale_[At(c)], 1e-3 * speed);
    const double e = std::max(
        combined(active.Relative(e5.data()), active.Relative(e3.data()), own_length),
        combined(active.Relative(e5.data() + n), active.Relative(e3.data() + n), own_speed));
    if (!(e <= norm)) norm = e;
  }
  return norm / scenario_.solver.relative_tolerance;
}

DeformationPath Motion::Path(int contact) const {
  const int n = equations_.bodies();
  const double bend = 2 * step_.h * (1 - step_.warp);  // d²t/dθ²
  const auto end = [&](const auto& y, const auto& slope, double theta) {
    const double rate = equations_.Relative(contact, y.data() + n);
    const double acceleration = equations_.Relative(contact, slope.data() + n);
    const double dt = step_.h * step_.Rate(theta);
    return DeformationPath::End{Deformation(contact, y.data()), dt * rate,
                                dt * dt * acceleration + bend * rate};
  };
  return {end(rk_.y0, rk_.slope0, 0), end(rk_.y1, rk_.slope1, 1)};
}

Motion::Found Motion::FindEvent() const {
  Found first;
  for (int c = 0; c < equations_.contacts(); ++c) {
    const auto event = FirstEvent(contacts_[At(c)].phase, Path(c), event_[At(c)]);
    if (!event) continue;
    if (first.contact == kNone || event->theta < first.event.theta) first = {c, *event};
  }
  if (first.contact == kNone && separating_ != kNone) {
    first = {separating_, {EventKind::kSeparation, 1}};  // Just short of it.
  }
  // Within round-off of the step's start is at its start.
  if (first.contact != kNone && first.event.theta < 1e-13) first.event.theta = 0;
  return first;
}

// Takes contacts through the turns inside the step: nothing changes for the motion there, so it
// need not stop. Returns the first event at which it must.
Motion::Found Motion::PassTurns() {
  const int n = equations_.bodies();
  bool prepared = false;
  while (true) {
    const Found found = FindEvent();
    if (found.contact == kNone || found.event.kind != EventKind::kTurn) return found;
    if (!prepared) PrepareInterpolation();
    prepared = true;
    double theta = found.event.theta;
    rk_.Interpolate(theta, &inside_);
    // One step of Newton from the quintic's turn to the solution's.
    const double acceleration =
        equations_.Relative(found.contact, rk_.slope0.data() + n) * (1 - theta) +
        equations_.Relative(found.contact, rk_.slope1.data() + n) * theta;
    const double late = equations_.Relative(found.contact, inside_.data() + n) / acceleration;
    theta = std::clamp(step_.Theta(step_.At(theta) - late), 0.0, 1.0);
    rk_.Interpolate(theta, &inside_);
    event_[At(found.contact)] = theta;
    Turn(contacts_[At(found.contact)], step_.At(theta), inside_);
  }
}

// Makes the step end on the event: Newton on its length with the true solution, started from the
// interpolated one, until the event's time is good to round-off.
void Motion::Land(const Found& found) {
  const bool parting = found.event.kind == EventKind::kSeparation;
  const double longest = 2 * step_.h;
  if (found.event.theta < 1) Repeat(step_.At(found.event.theta) - time_, parting);
  for (int i = 0; i < kMaxLandings; ++i) {
    const double correction = Correction(found);
    const double h = step_.h + correction;
    if (!(h > 0) || h > longest) return;
    if (std::abs(correction) <= 1e-7 * step_.h) {
      // So near that the tangent leads there: its error is of second order.
      rk_.y1 += correction * rk_.slope1;
      step_.h = h;
      rk_.FinishStep(equations_, step_);
      ++evaluations_;
      return;
    }
    Repeat(h, parting);
  }
}

void Motion::Repeat(double h, bool parting) {
  step_ = {.start = time_, .h = h, .warp = parting ? 2 : TouchWarp(h)};
  rk_.Step(equations_, step_);
  rk_.FinishStep(equations_, step_);
  ++steps_;
  evaluations_ += 12;
}

// By how much the step must be longer to end on the event, to first order.
double Motion::Correction(const Found& found) const {
  const int n = equations_.bodies();
  const double rate = equations_.Relative(found.contact, rk_.y1.data() + n);
  if (found.event.kind == EventKind::kNonSeparation) {
    return -rate / equations_.Relative(found.contact, rk_.slope1.data() + n);
  }
  return -Deformation(found.contact, rk_.y1.data()) / rate;
}

void Motion::Accept(StepListener* listener) {
  const int n = equations_.bodies();
  if (equations_.recording) {
    for (const ActiveContact& active : equations_.active) ObserveForce(active.contact);
    if (listener != nullptr) listener->OnStep(step_);
  }
  time_ += step_.h;
  rk_.Advance();
  if (equations_.active.empty()) {
    flight_length_ = std::max(flight_length_, rk_.y0.head(n).abs().maxCoeff());
    flight_speed_ = std::max(flight_speed_, rk_.y0.segment(n, n).abs().maxCoeff());
  }
  for (const ActiveContact& active : equations_.active) {
    const auto c = At(active.contact);
    const double moved =
        Deformation(active.contact, rk_.y0.data()) - contacts_[c].cycle.start_deformation;
    deformation_scale_[c] = std::max(deformation_scale_[c], std::abs(moved));
    velocity_scale_[c] = std::max(velocity_scale_[c],
                                  std::abs(equations_.Relative(active.contact, rk_.y0.data() + n)));
  }
}

}  // namespace contact
