// The part of Motion that takes contacts through their cycles; motion.cpp moves between events.
#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>

#include "simulation/motion/motion.h"

namespace contact {
namespace {

// A resting contact is awake when its work is this many times what lets it settle.
constexpr double kWakeFactor = 4;
// The scale to which a resting contact is integrated, relative to its deformation.
constexpr double kRestingScale = 1e-3;

std::size_t At(int index) { return static_cast<std::size_t>(index); }

// Whether a cycle that ends at `time` is none: it has no duration, or its compression did no work.
bool DoesNothing(const ContactState& state, double time) {
  const bool idle = state.phase == Phase::kRestitution && state.cycle.work_compression <= 0;
  return idle || time == state.cycle.start_time;
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
  const Cycle::Kind kind = state.cycle.kind;
  const bool touches = state.cycles == 0 || state.cycle.end == Cycle::End::kSeparation;
  if (touches) ++state.encounter;
  state.cycle = Cycle{};
  state.cycle.contact = contact;
  state.cycle.number = ++state.cycles;
  state.cycle.kind = kind;
  state.cycle.start_time = time_;
  if (kind == Cycle::Kind::kNirv) {
    state.cycle.start_deformation = std::max(0.0, Deformation(contact, rk_.y0.data()));
  }
  state.cycle.max_deformation = state.cycle.start_deformation;
  state.peak = {};
  if (kind == Cycle::Kind::kCollision) {
    state.cycle.approach_velocity = std::max(0.0, equations_.Relative(contact, rk_.y0.data() + n));
  }
  const Contact& c = scenario_.contacts[At(contact)];
  const double mass = equations_.effective_mass(contact);
  const double external_force =
      mass * equations_.Relative(contact, rk_.slope0.data() + n) +
      c.stiffness * Power(state.cycle.start_deformation, c.exponent).value;
  const CycleHost::Factor factor = host.OnStart(state, mass, external_force);
  state.cycle.mu = factor.mu;
  state.column = factor.column;
  state.phase = state.settled ? Phase::kResting : Phase::kCompression;

  if (factor.column >= equations_.columns && !equations_.recording) AddColumn();
  rk_.y0[equations_.work(contact)] = 0;
  for (int column = 0; !equations_.recording && column < equations_.columns; ++column) {
    rk_.y0[equations_.work_tangent(contact, column)] = 0;
  }
  if (equations_.recording) rk_.y0[equations_.external_work(contact)] = 0;
  start_gradient_[At(contact)] = WorkGradient(contact, rk_.y0);
  deformation_scale_[At(contact)] = factor.length;
  velocity_scale_[At(contact)] = std::max(factor.speed, state.cycle.approach_velocity);
  if (factor.length == 0 && kind == Cycle::Kind::kCollision) {
    const double v = state.cycle.approach_velocity;
    const double alpha = NeedsNoVelocity(c.damping) ? 0 : state.cycle.mu * v / c.stiffness;
    deformation_scale_[At(contact)] = MaximumDeformation(mass, v, c.stiffness, c.exponent, alpha);
  }
  if (kind == Cycle::Kind::kCollision) touch_time_ = time_;
  ShiftAtJump(contact, 1);
  if (state.settled) SetRestingScale(contact);
  const double first = FirstStep(contact);
  next_step_ = next_step_ == 0 ? first : std::min(next_step_, first);
}

// Makes room for one more μ to differentiate by; nothing depends on it yet.
void Motion::AddColumn() {
  const Eigen::Index coupled = equations_.coupled();
  const Eigen::ArrayXd works = rk_.y0.tail(rk_.size() - coupled);
  ++equations_.columns;
  rk_.Resize(equations_.size(), equations_.coupled());
  rk_.y0.tail(rk_.size() - coupled).setZero();
  rk_.y0.segment(equations_.coupled(), works.size()) = works;
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

void Motion::Apply(const Found& found, CycleHost& host) {
  ContactState& state = contacts_[At(found.contact)];
  switch (found.event.kind) {
    case EventKind::kTouch:
    case EventKind::kRestTouch: {
      const bool collides = found.event.kind == EventKind::kTouch;
      state.phase = Phase::kStarting;
      state.settled = false;
      state.cycle.kind = collides ? Cycle::Kind::kCollision : Cycle::Kind::kNirv;
      return;
    }
    case EventKind::kTurn:
      return;  // Dealt with inside the step.
    case EventKind::kSeparation:
    case EventKind::kNonSeparation:
      if (DoesNothing(state, time_)) return CancelCycle(state, host);
      EndCycle(state,
               found.event.kind == EventKind::kSeparation ? Cycle::End::kSeparation
                                                          : Cycle::End::kNonSeparation,
               host);
      return;
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
  cycle.work_compression = y[equations_.work(cycle.contact)];  // (W1)
  cycle.dissipated_compression = cycle.work_compression -
                                 ElasticEnergy(contact, cycle.max_deformation) +
                                 ElasticEnergy(contact, cycle.start_deformation);  // (W2)
  if (equations_.recording) {
    cycle.external_compression = y[equations_.external_work(cycle.contact)];
  }
  turn_gradient_[At(cycle.contact)] = WorkGradient(cycle.contact, y);
}

// Moves the end of compression to where F was largest. Returns the elastic energy there.
double Motion::SplitAtPeakForce(ContactState& state) const {
  Cycle& cycle = state.cycle;
  const Contact& contact = scenario_.contacts[At(cycle.contact)];
  const double energy = ElasticEnergy(contact, state.peak.deformation);
  cycle.turn_time = state.peak.time;
  cycle.work_compression = state.peak.work;
  cycle.external_compression = state.peak.external_work;
  cycle.dissipated_compression =
      state.peak.work - energy + ElasticEnergy(contact, cycle.start_deformation);
  return energy;
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
  double split_energy = ElasticEnergy(contact, cycle.max_deformation);
  double split_velocity = 0;
  if (split_at_force_ && !std::isnan(state.peak.time)) {
    split_energy = SplitAtPeakForce(state);
    split_velocity = state.peak.velocity;
  }
  cycle.work_restitution = rk_.y0[equations_.work(cycle.contact)] - cycle.work_compression;
  cycle.dissipated_restitution =
      cycle.work_restitution - ElasticEnergy(contact, cycle.end_deformation) + split_energy;
  const double ratio = -cycle.work_restitution / cycle.work_compression;
  cycle.restitution_out = cycle.work_compression > 0 && ratio >= 0 ? std::sqrt(ratio) : kNaN;
  if (equations_.recording) {
    cycle.external_restitution =
        rk_.y0[equations_.external_work(cycle.contact)] - cycle.external_compression;
    const double kinetic =
        0.5 * equations_.effective_mass(cycle.contact) *
        (cycle.approach_velocity * cycle.approach_velocity - split_velocity * split_velocity);
    cycle.identity_residual =
        std::abs(cycle.work_compression - kinetic - cycle.external_compression) /
        cycle.work_compression;  // (W4)
    contact_loss_ += cycle.dissipated_compression + cycle.dissipated_restitution;
  }
  // Up to here the gradients have the columns that existed then; later ones begin at zero.
  const auto extended = [&](const Eigen::ArrayXd& gradient) {
    Eigen::ArrayXd all = Eigen::ArrayXd::Zero(equations_.columns);
    all.head(gradient.size()) = gradient;
    return all;
  };
  const Eigen::ArrayXd start = extended(start_gradient_[At(cycle.contact)]);
  const Eigen::ArrayXd turn = extended(turn_gradient_[At(cycle.contact)]);
  if (separates) ShiftAtJump(cycle.contact, -1);
  state.phase = separates ? Phase::kOpen : Phase::kStarting;
  state.last_mu = cycle.mu;
  host.OnEnd(state, turn - start, extended(WorkGradient(cycle.contact, rk_.y0)) - turn,
             deformation_scale_[At(cycle.contact)], velocity_scale_[At(cycle.contact)]);
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
  if (c.damping_exponent != 0 || equations_.recording || rate == 0) return;
  const double force = sign * c.At(0, rate).force;
  for (int column = 0; column < equations_.columns; ++column) {
    double* tangent = rk_.y0.data() + equations_.tangent(column);
    const double late = -c.Relative(tangent) / rate;
    tangent[n + c.left] += force * c.left_inverse * late;
    tangent[n + c.right] -= force * c.right_inverse * late;
  }
}

// ∂W/∂μ of a contact for each column, (S2).
Eigen::ArrayXd Motion::WorkGradient(int contact, const Eigen::ArrayXd& y) const {
  Eigen::ArrayXd gradient(equations_.columns);
  for (int column = 0; column < equations_.columns; ++column) {
    gradient[column] = y[equations_.work_tangent(contact, column)];
  }
  return gradient;
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
  contacts_[At(contact)].peak = {
      .time = step_.At(theta),
      .deformation = Deformation(contact, inside_.data()),
      .velocity = equations_.Relative(contact, inside_.data() + n),
      .work = inside_[equations_.work(contact)],
      .external_work = equations_.recording ? inside_[equations_.external_work(contact)] : 0};
}

}  // namespace contact
