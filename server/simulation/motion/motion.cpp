#include "simulation/motion/motion.h"

#include <algorithm>
#include <cmath>

#include "simulation/model/derived.h"

namespace contact {
namespace {

constexpr int kMaxEventsAtOnce = 1000;
// What is this many times the error allowed is motion.
constexpr double kResolved = 100;
// A step meant to end in a separation has found it when so little of δ is left.
constexpr double kShort = 1e-3;

std::size_t At(int index) { return static_cast<std::size_t>(index); }

bool IsRunning(const ContactState& c) {
  return c.phase == Phase::kCompression || c.phase == Phase::kRestitution;
}

bool IsStarting(const ContactState& c) { return c.phase == Phase::kStarting; }

}  // namespace

bool IsPacking(const Scenario& scenario) {
  return !scenario.loads.empty() || !scenario.supports.empty() ||
         scenario.contacts.size() >= scenario.bodies.size();
}

bool InCycle(const State& state) {
  return std::ranges::any_of(state.contacts, [](const ContactState& c) {
    return IsRunning(c) || (IsStarting(c) && !c.settled);
  });
}

State InitialState(const Scenario& scenario) {
  State state;
  for (const Body& body : scenario.bodies) {
    state.positions.push_back(body.position);
    state.velocities.push_back(body.velocity);
  }
  const auto velocity = [&](int body) {
    return body == kNone ? 0 : scenario.bodies[At(body)].velocity;
  };
  for (const Contact& c : scenario.contacts) {
    ContactState contact;
    contact.gap = InitialGap(scenario, c);
    if (contact.gap <= 0 && velocity(c.left) - velocity(c.right) > 0) {
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
      fixed_step_(scenario.solver.fixed_step),
      split_at_force_(scenario.solver.phase_split == PhaseSplit::kPeakForce),
      shifts_(fixed_step_ == 0 && !IsPacking(scenario)),
      equations_(scenario),
      rk_(fixed_step_ > 0 ? RungeKutta::Method::kClassical : RungeKutta::Method::kDormandPrince),
      deformation_scale_(scenario.contacts.size()),
      velocity_scale_(scenario.contacts.size()),
      tangents_(scenario, equations_),
      turn_gradient_(scenario.contacts.size()),
      error5_(2 * scenario.bodies.size()),
      error3_(2 * scenario.bodies.size()),
      tolerance_(scenario.solver.relative_tolerance),
      event_(scenario.contacts.size()) {}

void Motion::Begin(const State& state, bool recording, double tolerance) {
  const int n = equations_.bodies();
  tolerance_ = tolerance > 0 ? tolerance : scenario_.solver.relative_tolerance;
  time_ = state.time;
  next_step_ = state.step;
  contacts_ = state.contacts;
  totals_.load_work = state.load_work;
  totals_.support_loss = state.support_loss;
  totals_.contact_loss = state.contact_loss;
  totals_.impulse = state.impulse;
  contact_loss_ = state.contact_loss;
  flight_length_ = flight_speed_ = 0;
  touch_time_ = kNaN;
  cruise_ = 0;

  equations_.base = state.positions;
  equations_.recording = recording;
  tangents_.Clear();
  SelectLoads();
  rk_.Resize(equations_.size(), equations_.coupled());
  rk_.y0.setZero();
  for (int i = 0; i < n; ++i) rk_.y0[n + i] = state.velocities[At(i)];
  for (int c = 0; c < equations_.contacts(); ++c) {
    ContactState& contact = contacts_[At(c)];
    rk_.y0[equations_.work(c)] = contact.work;
    if (recording) rk_.y0[equations_.external_work(c)] = contact.external_work;
    turn_gradient_[At(c)].resize(0);
    deformation_scale_[At(c)] = std::abs(contact.gap + contact.cycle.start_deformation);
    velocity_scale_[At(c)] = contact.cycle.approach_velocity;
    if (contact.phase == Phase::kResting) SetRestingScale(c);
  }
  RefreshActive();
}

State Motion::Save() const {
  const int n = equations_.bodies();
  State state = totals_;
  state.time = time_;
  state.step = next_step_;
  state.contacts = contacts_;
  state.positions = equations_.base;
  for (int i = 0; i < n; ++i) state.positions[At(i)] += rk_.y0[i];
  state.velocities.assign(rk_.y0.begin() + n, rk_.y0.begin() + n + n);
  for (int c = 0; c < equations_.contacts(); ++c) {
    ContactState& contact = state.contacts[At(c)];
    contact.gap = -Deformation(c, rk_.y0.data());
    contact.work = rk_.y0[equations_.work(c)];
    if (equations_.recording) contact.external_work = rk_.y0[equations_.external_work(c)];
  }
  if (equations_.recording) {
    state.load_work += rk_.y0[equations_.load_work()];
    state.support_loss += rk_.y0[equations_.support_loss()];
    state.impulse += rk_.y0[equations_.impulse()];
  }
  return state;
}

double Motion::ExternalWork(int contact, const Eigen::ArrayXd& y) const {
  return equations_.recording ? y[equations_.external_work(contact)] : 0;
}

double Motion::Deformation(int contact, const double* y) const {
  return equations_.Relative(contact, y) - contacts_[At(contact)].gap;
}

void Motion::PrepareInterpolation() {
  rk_.PrepareInterpolation(equations_, step_);
  if (fixed_step_ == 0) evaluations_ += 3;
}

Motion::Pause Motion::Advance(double until, CycleHost& host, StepListener* listener,
                              const std::stop_token& stop, std::int64_t step_limit) {
  StartCycles(host, false);
  const bool busy = Busy();
  if (equations_.active.empty()) next_step_ = 0;  // That of the cycles before tells nothing.
  int events_at_once = 0;
  while (true) {
    if (time_ >= until) return Pause::kTimeUp;
    if (stop.stop_requested()) return Pause::kStopped;
    if (steps_ >= step_limit) return Pause::kStepLimit;
    if (!host.OnStep()) return Pause::kEnough;
    if (!TakeStep(until)) return Pause::kNumeric;
    Found found = PassTurns();
    const bool moves = found.contact == kNone || found.event.theta > 0;
    if (moves && found.contact != kNone && !Land(found)) found.contact = kNone;
    if (moves && !rk_.y1.head(2 * equations_.bodies()).allFinite()) return Pause::kNumeric;
    if (moves) {
      Accept(listener);
    } else {
      next_step_ = step_.h;  // The same again, but for what begins.
    }
    if (found.contact != kNone) Apply(found, host);
    if (shifts_ && found.contact != kNone && found.event.kind == EventKind::kSeparation) {
      next_step_ = std::max(next_step_, cruise_);
    }
    const bool changes = found.contact != kNone || resting_;
    if (resting_) WakeResting(host);
    events_at_once = moves ? 0 : events_at_once + 1;
    if (events_at_once > kMaxEventsAtOnce) return Pause::kNumeric;
    if (changes) {
      StartCycles(host, !Busy());
      if (busy && !Busy()) return Pause::kQuiet;
      if (!busy && std::ranges::any_of(contacts_, IsStarting)) return Pause::kCycleStarts;
    }
  }
}

bool Motion::Busy() const { return std::ranges::any_of(contacts_, IsRunning); }

void Motion::SelectLoads() {
  breakpoint_ = equations_.SelectLoads(time_);
  forcing_time_ = equations_.ForcingTime();
}

void Motion::RefreshActive() {
  equations_.active.clear();
  resting_ = false;
  for (int c = 0; c < equations_.contacts(); ++c) {
    const ContactState& contact = contacts_[At(c)];
    if (!InTouch(contact.phase)) continue;
    resting_ |= contact.phase == Phase::kResting;
    equations_.active.push_back(
        equations_.Activate(c, contact.gap, contact.cycle.mu, contact.column));
  }
  equations_.Prepare();
  if (tangents_.count() > 0) tangents_.Prepare();
  equations_(time_, rk_.y0.data(), rk_.slope0.data());
  ++evaluations_;
}

std::pair<DeformationPath::End, DeformationPath::End> Motion::PathEnds(int contact) const {
  const int n = equations_.bodies();
  const Sides& sides = equations_.sides(contact);
  const double gap = contacts_[At(contact)].gap;
  const double bend = 2 * step_.h * (1 - step_.warp);  // d²t/dθ²
  const auto end = [&](const auto& y, const auto& slope, double theta) {
    const double rate = sides.Relative(y.data() + n);
    const double acceleration = sides.Relative(slope.data() + n);
    const double dt = step_.h * step_.Rate(theta);
    return DeformationPath::End{sides.Relative(y.data()) - gap, dt * rate,
                                dt * dt * acceleration + bend * rate};
  };
  return {end(rk_.y0, rk_.slope0, 0), end(rk_.y1, rk_.slope1, 1)};
}

// What round-off and the integrator's error may make of the deformation of two bodies at relative
// rest [m].
double Motion::Noise(int contact) const {
  const Contact& c = scenario_.contacts[At(contact)];
  double noise = 0;
  for (const ActiveContact& active : equations_.active) {
    noise = std::max(noise, kResolved * tolerance_ * deformation_scale_[At(active.contact)]);
  }
  for (const int body : {c.left, c.right}) {
    if (body == kNone) continue;
    noise += 1e-12 * std::max(std::abs(rk_.y0[body]), std::abs(rk_.y1[body])) +
             1e-15 * (std::abs(equations_.base[At(body)]) + scenario_.bodies[At(body)].radius);
  }
  return noise;
}

Motion::Found Motion::FindEvent() const {
  Found first;
  for (int c = 0; c < equations_.contacts(); ++c) {
    const Phase phase = contacts_[At(c)].phase;
    const auto [start, end] = PathEnds(c);
    if (DeformationPath::IsPlain(phase, start, end)) continue;
    const double noise = phase == Phase::kOpen ? Noise(c) : 0;
    const auto event = FirstEvent(phase, {start, end}, event_[At(c)], noise);
    if (!event) continue;
    if (first.contact == kNone || event->theta < first.event.theta) first = {c, *event};
  }
  if (first.contact == kNone && separating_ != kNone &&
      Deformation(separating_, rk_.y1.data()) < kShort * Deformation(separating_, rk_.y0.data())) {
    first = {separating_, {EventKind::kSeparation, 1}};
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
  turns_.clear();
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
    const double late = acceleration == 0  // As where a cycle from rest turns at once.
                            ? 0
                            : equations_.Relative(found.contact, inside_.data() + n) / acceleration;
    theta = std::clamp(step_.Theta(step_.At(theta) - late), 0.0, 1.0);
    rk_.Interpolate(theta, &inside_);
    event_[At(found.contact)] = theta;
    turns_.emplace_back(found.contact, step_.At(theta));
    Turn(contacts_[At(found.contact)], step_.At(theta), inside_);
  }
}

void Motion::FollowStep() {
  paths_.clear();
  for (const ActiveContact& active : equations_.active) {
    const auto [start, end] = PathEnds(active.contact);
    paths_.emplace_back(start, end);
  }
  double from = 0;
  for (const auto& [contact, time] : turns_) {
    const double theta = std::min(step_.Theta(time), 1.0);
    tangents_.Follow(step_, paths_, from, theta);
    turn_gradient_[At(contact)] = tangents_.Work(contact);
    from = std::max(from, theta);
  }
  tangents_.Follow(step_, paths_, from, 1);
}

void Motion::Accept(StepListener* listener) {
  const int n = equations_.bodies();
  if (equations_.recording || split_at_force_) {
    for (const ActiveContact& active : equations_.active) ObserveForce(active);
  }
  if (tangents_.count() > 0) FollowStep();
  if (listener != nullptr) listener->OnStep(step_);
  const bool breaks = step_.h >= breakpoint_ - time_;
  time_ = breaks ? breakpoint_ : time_ + step_.h;
  rk_.Advance();
  if (breaks) {
    SelectLoads();
    RefreshActive();
  }
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
