#include "simulation/motion/motion.h"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>

#include "simulation/model/contact_spring.h"
#include "simulation/model/index.h"

namespace contact {
namespace {

constexpr int kMaxEventsAtOnce = 1000;

}  // namespace

Motion::Motion(const Scenario& scenario)
    : system_(scenario),
      stepper_(system_),
      events_(system_),
      cycles_(system_),
      slips_(system_),
      forces_(system_) {}

void Motion::Begin(const State& state, bool recording, double tolerance) {
  totals_.load_work = state.load_work;
  totals_.support_loss = state.support_loss;
  totals_.impulse = state.impulse;
  system_.Begin(state, recording, tolerance);
  cycles_.Begin();
  stepper_.Begin();
}

State Motion::Save() const {
  const int n = system_.equations.bodies();
  State state = totals_;
  state.contact_loss = system_.contact_loss;
  state.time = system_.time;
  state.step = system_.next_step;
  state.contacts = system_.contacts;
  state.slips = system_.equations.slips;
  state.positions = system_.equations.base();
  for (int i = 0; i < n; ++i) state.positions[At(i)] += system_.rk.y0[i];
  state.velocities.assign(system_.rk.y0.begin() + n, system_.rk.y0.begin() + n + n);
  for (int c = 0; c < system_.equations.contacts(); ++c) {
    ContactState& contact = state.contacts[At(c)];
    contact.gap = -system_.Deformation(c, system_.rk.y0.data());
    contact.work = system_.rk.y0[system_.equations.work(c)];
    contact.largest_motion = system_.scales[At(c)].length;
    contact.largest_speed = system_.scales[At(c)].speed;
    if (system_.equations.recording) {
      contact.external_work = system_.rk.y0[system_.equations.external_work(c)];
    }
  }
  if (system_.equations.recording) {
    state.load_work += system_.rk.y0[system_.equations.load_work()];
    state.support_loss += system_.rk.y0[system_.equations.support_loss()];
    state.impulse += system_.rk.y0[system_.equations.impulse()];
  }
  return state;
}

Exchanged Motion::ExchangedUntil(const Eigen::ArrayXd& y) const {
  const Equations& equations = system_.equations;
  double lost = totals_.support_loss + y[equations.support_loss()] + system_.contact_loss;
  for (const ActiveContact& active : equations.active) {
    const Contact& contact = system_.scenario.contacts[At(active.contact)];
    const double deformation = active.Relative(y.data()) - active.gap;
    lost += y[equations.work(active.contact)] - ElasticEnergy(contact, deformation, active.yield) +
            system_.contacts[At(active.contact)].stored;
  }
  return {.dissipated = lost, .load_work = totals_.load_work + y[equations.load_work()]};
}

Motion::Pause Motion::Advance(double until, CycleHost& host, StepListener* listener,
                              const std::stop_token& stop, std::int64_t step_limit) {
  cycles_.AskRests(host);
  cycles_.Start(host, false);
  const bool busy = cycles_.Run();
  if (system_.equations.active.empty()) {
    system_.next_step = 0;  // That of the cycles before tells nothing.
  }
  int events_at_once = 0;
  while (true) {
    if (system_.time >= until) return Pause::kTimeUp;
    if (stop.stop_requested()) return Pause::kStopped;
    if (system_.steps >= step_limit) return Pause::kStepLimit;
    if (!host.OnStep()) return Pause::kEnough;
    events_.Restart();
    if (!stepper_.Take(std::min(until, cycles_.NextWake()))) return Pause::kNumeric;
    StepEvents::Found found = PassTurns();
    const bool moves = !found.any() || found.event.theta > 0;
    if (moves && found.any() && !stepper_.Land(found)) found = {};
    if (moves && !system_.rk.y1.head(2 * system_.equations.bodies()).allFinite()) {
      return Pause::kNumeric;
    }
    bool breaks = false;
    if (moves) {
      breaks = Accept(listener);
    } else if (found.contact == kNone || stepper_.separating() != found.contact) {
      system_.next_step = system_.step.h;  // The same again, but for what begins.
    }
    if (found.contact != kNone) cycles_.Apply(found, host);
    if (found.support != kNone) slips_.Apply(found);
    const bool separates = found.event.kind == EventKind::kSeparation;
    if (found.contact != kNone && separates) stepper_.Separated();
    const bool changes = found.contact != kNone || system_.resting;
    if (system_.resting) cycles_.WakeDisturbed(breaks, host);
    events_at_once = moves ? 0 : events_at_once + 1;
    if (events_at_once > kMaxEventsAtOnce) return Pause::kNumeric;
    if (changes) {
      cycles_.Start(host, !cycles_.Run());
      if (busy && !cycles_.Run()) return Pause::kQuiet;
      if (!busy && cycles_.Wait()) return Pause::kCycleStarts;
    }
  }
}

// Takes contacts through the turns inside the step: nothing changes for the motion there, so it
// need not stop, but for a contact that yields. Returns the first event at which it must.
StepEvents::Found Motion::PassTurns() {
  turns_.clear();
  while (true) {
    const StepEvents::Found found = events_.First(stepper_.separating());
    if (found.contact == kNone || found.event.kind != EventKind::kTurn) return found;
    if (system_.scenario.contacts[At(found.contact)].table.yields()) return found;
    if (turns_.empty()) system_.PrepareInterpolation();
    PassTurn(found.contact, found.event.theta);
  }
}

void Motion::PassTurn(int contact, double theta) {
  const Sides& sides = system_.equations.sides(contact);
  theta = system_.implicit ? SearchTurn(sides, theta) : CorrectTurn(sides, theta);
  system_.Interpolate(theta, &inside_);
  events_.Pass(contact, theta);
  turns_.emplace_back(contact, system_.step.At(theta));
  cycles_.Turn(contact, system_.step.At(theta), inside_);
}

double Motion::CorrectTurn(const Sides& sides, double theta) {
  const int n = system_.equations.bodies();
  const StepTime& step = system_.step;
  system_.Interpolate(theta, &inside_);
  // One step of Newton from the quintic's turn to the solution's.
  const double acceleration = sides.Relative(system_.rk.slope0.data() + n) * (1 - theta) +
                              sides.Relative(system_.rk.slope1.data() + n) * theta;
  const double late = acceleration == 0  // As where a cycle from rest turns at once.
                          ? 0
                          : sides.Relative(inside_.data() + n) / acceleration;
  return std::clamp(step.Theta(step.At(theta) - late), 0.0, 1.0);
}

double Motion::SearchTurn(const Sides& sides, double theta) {
  const auto rate = [&](double at) {
    system_.Interpolate(at, &inside_);
    return sides.Relative(inside_.data() + system_.equations.bodies());
  };
  const double first = rate(0), last = rate(1);
  if (!(first > 0 && last < 0)) return theta;
  std::uintmax_t trials = 30;
  const auto bracket = boost::math::tools::toms748_solve(
      rate, 0.0, 1.0, first, last, boost::math::tools::eps_tolerance<double>(30), trials);
  return bracket.first;
}

void Motion::FollowStep() {
  paths_.clear();
  for (const ActiveContact& active : system_.equations.active) {
    const auto [start, end] = system_.PathEnds(active.contact);
    paths_.emplace_back(start, end);
  }
  for (std::size_t i = 0; i < system_.scenario.supports.size(); ++i) {
    if (system_.scenario.supports[i].higher.empty()) continue;
    const auto [start, end] = system_.StretchEnds(i);
    paths_.emplace_back(start, end);
  }
  double from = 0;
  for (const auto& [contact, time] : turns_) {
    const double theta = std::min(system_.step.Theta(time), 1.0);
    system_.tangents.Follow(system_.step, paths_, from, theta);
    cycles_.KeepTurnGradient(contact);
    from = std::max(from, theta);
  }
  system_.tangents.Follow(system_.step, paths_, from, 1);
}

bool Motion::Accept(StepListener* listener) {
  if (system_.equations.recording) {
    const double* y = system_.rk.y1.data();
    system_.momentum_scale = std::max(system_.momentum_scale, system_.equations.MomentumScale(y));
    system_.energy_scale = std::max(system_.energy_scale, system_.equations.Energy(y));
  }
  if (system_.equations.recording || system_.splits_at_force()) {
    for (const ActiveContact& active : system_.equations.active) forces_.Observe(active);
  }
  if (system_.tangents.count() > 0) FollowStep();
  if (listener != nullptr) listener->OnStep(system_.step);
  if (system_.resting) cycles_.FollowRests();
  const bool breaks = system_.step.h >= system_.breakpoint - system_.time;
  const bool ends = system_.step.h >= stepper_.until() - system_.time;
  system_.time = breaks ? system_.breakpoint
                 : ends ? stepper_.until()
                        : system_.time + system_.step.h;
  system_.rk.Advance();
  if (breaks) {
    system_.SelectLoads();
    system_.RefreshActive();
  }
  stepper_.Widen();
  return breaks;
}

}  // namespace contact
