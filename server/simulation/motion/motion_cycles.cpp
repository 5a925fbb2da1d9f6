// The part of Motion that takes contacts through their cycles; motion.cpp moves between events.
#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cassert>
#include <cmath>
#include <limits>

#include "simulation/motion/cycle_works.h"
#include "simulation/motion/motion.h"

namespace contact {
namespace {

// A resting contact is awake when its work is this many times what lets it settle.
constexpr double kWakeFactor = 4;
// The scale to which a resting contact is integrated, relative to its deformation.
constexpr double kRestingScale = 1e-3;

std::size_t At(int index) { return static_cast<std::size_t>(index); }

// Whether a cycle that ends at `time` is none: it has no duration, or began at δ = 0 and did no
// work in compression, so that it has none to give back.
bool DoesNothing(const ContactState& state, double time) {
  const Cycle& cycle = state.cycle;
  const bool idle = cycle.work_compression <= 0 || cycle.max_deformation <= 0;
  const bool turned = state.phase == Phase::kRestitution && cycle.start_deformation == 0;
  return (turned && idle) || time == cycle.start_time;
}

}  // namespace

void Motion::StartCycles(CycleHost& host, bool resting_only) {
  bool any = false;
  for (int c = 0; c < equations_.contacts(); ++c) {
    const ContactState& contact = contacts_[At(c)];
    if (contact.phase != Phase::kStarting || (resting_only && !contact.settled)) continue;
    StartCycle(c, host);
    any = true;
    if (contact.cycle.kind == Cycle::Kind::kCollision) StartPushed(c, host);
  }
  if (any) RefreshActive();
}

// What touches the bodies of a collision at rest begins with it.
void Motion::StartPushed(int collision, CycleHost& host) {
  const int n = equations_.bodies();
  for (int c = 0; c < equations_.contacts(); ++c) {
    ContactState& contact = contacts_[At(c)];
    const Sides& sides = equations_.sides(c);
    if (contact.phase != Phase::kOpen || !equations_.sides(collision).Pushes(sides)) continue;
    const double* y = rk_.y0.data();  // Which a cycle that starts may move.
    const bool at_rest = Deformation(c, y) == 0 && sides.Relative(y + n) == 0;
    if (!at_rest || sides.Relative(rk_.slope0.data() + n) < 0) continue;
    contact.settled = false;
    contact.cycle.kind = Cycle::Kind::kNirv;
    StartCycle(c, host);
  }
}

void Motion::StartCycle(int contact, CycleHost& host) {
  const int n = equations_.bodies();
  ContactState& state = contacts_[At(contact)];
  const bool collides = state.cycle.kind == Cycle::Kind::kCollision;
  const bool touches = state.cycles == 0 || state.cycle.end == Cycle::End::kSeparation;
  if (touches) ++state.encounter;
  const double deformation = collides ? 0 : std::max(0.0, Deformation(contact, rk_.y0.data()));
  const double approach =
      collides ? std::max(0.0, equations_.Relative(contact, rk_.y0.data() + n)) : 0;
  state.cycle = {.contact = contact,
                 .number = ++state.cycles,
                 .kind = state.cycle.kind,
                 .start_time = time_,
                 .start_deformation = deformation,
                 .max_deformation = deformation,
                 .approach_velocity = approach};
  state.peak = {};
  const Contact& c = scenario_.contacts[At(contact)];
  const double mass = equations_.effective_mass(contact);
  const double external_force = mass * equations_.Relative(contact, rk_.slope0.data() + n) +
                                c.stiffness * Power(deformation, c.exponent).value;
  const CycleHost::Factor factor = host.OnStart(state, mass, external_force);
  state.cycle.mu = factor.mu;
  state.column = factor.column;
  state.phase = state.settled ? Phase::kResting : Phase::kCompression;

  if (factor.column >= tangents_.count() && !equations_.recording) tangents_.Add();
  rk_.y0[equations_.work(contact)] = 0;
  tangents_.Restart(contact);
  if (equations_.recording) rk_.y0[equations_.external_work(contact)] = 0;
  deformation_scale_[At(contact)] = factor.length;
  velocity_scale_[At(contact)] = std::max(factor.speed, approach);
  if (factor.length == 0 && collides) {
    const double alpha = NeedsNoVelocity(c.damping) ? 0 : factor.mu * approach / c.stiffness;
    deformation_scale_[At(contact)] =
        MaximumDeformation(mass, approach, c.stiffness, c.exponent, alpha);
  }
  if (collides) touch_time_ = time_;
  ShiftAtJump(contact, 1);
  state.duration = ExpectedDuration(contact);
  if (state.settled) SetRestingScale(contact);
  const double first = FirstStep(contact);
  next_step_ = next_step_ == 0 ? first : std::min(next_step_, first);
}

void Motion::SetRestingScale(int contact) {
  const Contact& c = scenario_.contacts[At(contact)];
  const double deformation = contacts_[At(contact)].cycle.start_deformation;
  const double stiffness = c.stiffness * Power(deformation, c.exponent).slope;
  deformation_scale_[At(contact)] = kRestingScale * deformation;
  velocity_scale_[At(contact)] =
      kRestingScale * deformation * std::sqrt(stiffness / equations_.effective_mass(contact));
}

// A small part of the cycle's duration, from the law's own scales.
double Motion::FirstStep(int contact) const {
  const int n = equations_.bodies();
  const Contact& c = scenario_.contacts[At(contact)];
  const Cycle& cycle = contacts_[At(contact)].cycle;
  const double mass = equations_.effective_mass(contact);
  if (cycle.approach_velocity > 0) {
    const double v = cycle.approach_velocity;
    // In √t the error grows with the 9th power, t^4.5.
    return std::min(4 * std::pow(tolerance_, 2.0 / 9), 0.2) *
           MaximumDeformation(mass, v, c.stiffness, c.exponent, 0) / v;
  }
  double deformation = cycle.start_deformation;
  if (deformation == 0) {  // The load's equilibrium.
    const double a = std::abs(equations_.Relative(contact, rk_.slope0.data() + n));
    deformation = std::pow(mass * a / c.stiffness, 1 / c.exponent);
  }
  const double stiffness = c.stiffness * Power(deformation, c.exponent).slope;
  return stiffness > 0 ? 0.1 / std::sqrt(stiffness / mass) : std::numeric_limits<double>::max();
}

// Three times the largest δ − δ_s over the largest |δ̇|: Hertz's elastic impact takes 2.94 of these,
// a swing about the load's equilibrium π. Damping makes it longer.
double Motion::ExpectedDuration(int contact) const {
  const double length = deformation_scale_[At(contact)], speed = velocity_scale_[At(contact)];
  return length > 0 && speed > 0 ? 3 * length / speed : 0;
}

void Motion::Apply(const Found& found, CycleHost& host) {
  ContactState& state = contacts_[At(found.contact)];
  const EventKind kind = found.event.kind;
  assert(kind != EventKind::kTurn);  // PassTurns has dealt with it.
  if (kind == EventKind::kTouch || kind == EventKind::kRestTouch) {
    state.phase = Phase::kStarting;
    state.settled = false;
    state.cycle.kind = kind == EventKind::kTouch ? Cycle::Kind::kCollision : Cycle::Kind::kNirv;
  } else if (DoesNothing(state, time_)) {
    CancelCycle(state, host);
  } else {
    const bool separates = kind == EventKind::kSeparation;
    EndCycle(state, separates ? Cycle::End::kSeparation : Cycle::End::kNonSeparation, host);
  }
}

// A resting contact whose work has become worth a cycle of its own ends its rest.
void Motion::WakeResting(CycleHost& host) {
  for (int c = 0; c < equations_.contacts(); ++c) {
    ContactState& state = contacts_[At(c)];
    if (state.phase != Phase::kResting) continue;
    const Contact& contact = scenario_.contacts[At(c)];
    const double deformation = Deformation(c, rk_.y0.data());
    const double work = contact.stiffness * Power(deformation, contact.exponent).value *
                        std::abs(deformation - state.cycle.start_deformation);
    if (work > kWakeFactor * scenario_.solver.settled_nirv_fraction * state.largest_work) {
      EndCycle(state, Cycle::End::kNonSeparation, host);
      state.settled = false;
    }
  }
}

void Motion::Turn(ContactState& state, double time, const Eigen::ArrayXd& y) {
  Cycle& cycle = state.cycle;
  const Contact& contact = scenario_.contacts[At(cycle.contact)];
  state.phase = Phase::kRestitution;
  cycle.turn_time = time;
  cycle.max_deformation = Deformation(cycle.contact, y.data());
  SetCompression(contact, cycle.max_deformation, y[equations_.work(cycle.contact)],
                 ExternalWork(cycle.contact, y), &cycle);
  turn_gradient_[At(cycle.contact)] = tangents_.Work(cycle.contact);
}

void Motion::EndCycle(ContactState& state, Cycle::End end, CycleHost& host) {
  Cycle& cycle = state.cycle;
  const Contact& contact = scenario_.contacts[At(cycle.contact)];
  const int n = equations_.bodies();
  const bool separates = end == Cycle::End::kSeparation;
  if (state.phase == Phase::kResting)
    Turn(state, time_, rk_.y0);  // Its works count as one compression.
  cycle.end = end;
  cycle.end_time = time_;
  cycle.end_deformation = separates ? 0 : Deformation(cycle.contact, rk_.y0.data());
  cycle.separation_velocity = separates ? equations_.Relative(cycle.contact, rk_.y0.data() + n) : 0;
  const ContactState::Peak& peak = state.peak;
  const bool at_force = split_at_force_ && !std::isnan(peak.time);
  if (at_force) {
    cycle.turn_time = peak.time;
    SetCompression(contact, peak.deformation, peak.work, peak.external_work, &cycle);
  }
  SetRestitution(contact, at_force ? peak.deformation : cycle.max_deformation,
                 rk_.y0[equations_.work(cycle.contact)], ExternalWork(cycle.contact, rk_.y0),
                 &cycle);
  const double ratio = -cycle.work_restitution / cycle.work_compression;
  cycle.restitution_out = cycle.work_compression > 0 && ratio >= 0 ? std::sqrt(ratio) : kNaN;
  if (equations_.recording) {
    const double split_velocity = at_force ? peak.velocity : 0;
    const double kinetic =
        0.5 * equations_.effective_mass(cycle.contact) *
        (cycle.approach_velocity * cycle.approach_velocity - split_velocity * split_velocity);
    cycle.identity_residual =
        std::abs(cycle.work_compression - kinetic - cycle.external_compression) /
        cycle.work_compression;  // (W4)
    totals_.contact_loss += cycle.dissipated_compression + cycle.dissipated_restitution;
  }
  const Eigen::ArrayXd gradient = tangents_.Work(cycle.contact);
  // It has the μ that there were then; later ones begin at 0.
  Eigen::ArrayXd& turn = turn_gradient_[At(cycle.contact)];
  turn.conservativeResizeLike(Eigen::ArrayXd::Zero(gradient.size()));
  if (separates) ShiftAtJump(cycle.contact, -1);
  state.phase = separates ? Phase::kOpen : Phase::kStarting;
  state.last_mu = cycle.mu;
  host.OnEnd(state, turn, gradient - turn, deformation_scale_[At(cycle.contact)],
             velocity_scale_[At(cycle.contact)]);
  state.largest_work = std::max(state.largest_work, cycle.work_compression);
  state.cycle.kind = Cycle::Kind::kNirv;  // What follows a non-separation.
  rk_.y0[equations_.work(cycle.contact)] = 0;
  if (equations_.recording) rk_.y0[equations_.external_work(cycle.contact)] = 0;
  RefreshActive();
}

// Takes back a cycle that does nothing: a load parts touching bodies as their cycle begins. The
// next step is shorter, so that it does not see the same again.
void Motion::CancelCycle(ContactState& state, CycleHost& host) {
  const int contact = state.cycle.contact;
  host.OnCancel(state);
  state.phase = state.cycle.start_deformation > 0 ? Phase::kStarting : Phase::kOpen;
  const bool opened = state.cycles == 1 || state.cycle.start_deformation == 0;
  if (opened) {  // There was no encounter: the next has its number.
    --state.encounter;
    state.cycle.end = Cycle::End::kSeparation;
  }
  --state.cycles;
  rk_.y0[equations_.work(contact)] = 0;
  if (equations_.recording) rk_.y0[equations_.external_work(contact)] = 0;
  next_step_ /= 2;
  RefreshActive();
}

// (S3): where a force that is not 0 begins (sign 1) or ends (−1), a change of that instant changes
// the velocities after it.
void Motion::ShiftAtJump(int contact, double sign) {
  const int n = equations_.bodies();
  const ContactState& state = contacts_[At(contact)];
  const ActiveContact c = equations_.Activate(contact, state.gap, state.cycle.mu, kNone);
  const double rate = c.Relative(rk_.y0.data() + n);
  if (c.damping_exponent != 0 || rate == 0) return;
  tangents_.Jump(c, sign * c.At(0, rate).force / rate);
}

// Peak force and pulling time over the step.
void Motion::ObserveForce(const ActiveContact& active) {
  const int n = equations_.bodies();
  Cycle& cycle = contacts_[At(active.contact)].cycle;
  ActiveContact law = active;
  law.clipped = false;
  struct End {
    double force, growth;  // F, dF/dt.
  };
  const auto end = [&](const Eigen::ArrayXd& y, const Eigen::ArrayXd& slope) {
    const double rate = law.Relative(y.data() + n);
    const ActiveContact::Force f = law.At(law.Relative(y.data()) - law.gap, rate);
    return End{f.force, f.by_deformation * rate + f.by_rate * law.Relative(slope.data() + n)};
  };
  const End first = end(rk_.y0, rk_.slope0), last = end(rk_.y1, rk_.slope1);
  const bool pulls = first.force < 0 || last.force < 0;  // Nowhere else in a step does it pull.
  const bool peaks = first.growth >= 0 && last.growth < 0;
  double where = last.force > first.force ? 1 : 0;
  double largest = std::max(first.force, last.force);
  if (pulls || peaks) {
    const auto ends = PathEnds(active.contact);
    const DeformationPath path(ends.first, ends.second);
    const auto force = [&](double theta) {
      const double dt = step_.h * step_.Rate(theta);
      return law.At(path.Value(theta), dt > 0 ? path.Slope(theta) / dt : 0).force;
    };
    for (int i = 0; pulls && i < 8; ++i) {
      if (force((i + 0.5) / 8) < 0) {
        cycle.tension_time += step_.At((i + 1) / 8.0) - step_.At(i / 8.0);
      }
    }
    if (peaks) {
      const auto peak = boost::math::tools::brent_find_minima(
          [&](double theta) { return -force(theta); }, 0.0, 1.0, 40);
      if (-peak.second > largest) where = peak.first, largest = -peak.second;
    }
  }
  if (largest <= cycle.peak_force) return;
  cycle.peak_force = largest;
  if (split_at_force_) KeepPeak(active.contact, where);
}

void Motion::KeepPeak(int contact, double theta) {
  const int n = equations_.bodies();
  PrepareInterpolation();
  rk_.Interpolate(theta, &inside_);
  contacts_[At(contact)].peak = {.time = step_.At(theta),
                                 .deformation = Deformation(contact, inside_.data()),
                                 .velocity = equations_.Relative(contact, inside_.data() + n),
                                 .work = inside_[equations_.work(contact)],
                                 .external_work = ExternalWork(contact, inside_)};
}

}  // namespace contact
