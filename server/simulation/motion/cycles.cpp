#include "simulation/motion/cycles.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "simulation/model/contact_spring.h"
#include "simulation/model/derived.h"
#include "simulation/model/index.h"
#include "simulation/motion/cycle_works.h"

namespace contact {
namespace {

// A contact that is let go with a force this part of its own less than before falls at once.
constexpr double kLetGo = 0.05;
// The scale to which a contact is integrated that rests or begins compressed, relative to its
// deformation: what swings by 1e-4 of it is negligible. With 1e-5 a contact whose swing no pass has
// measured yet takes ten times the steps (2,631 for 226 where a sine presses it, λ = 3e5/s).
constexpr double kCompressedScale = 1e-3;

// Whether a cycle that ends at `time` is none: it has no duration, or began at δ = 0 and did no
// work in compression, so that it has none to give back.
bool DoesNothing(const ContactState& state, double time) {
  const Cycle& cycle = state.cycle;
  const bool idle = cycle.work_compression <= 0 || cycle.max_deformation <= 0;
  const bool turned = state.phase == Phase::kRestitution && cycle.start_deformation == 0;
  return (turned && idle) || time == cycle.start_time;
}

}  // namespace

Cycles::Cycles(MovingSystem& system)
    : system_(system), rest_(system), turn_gradient_(system.scenario.contacts.size()) {}

void Cycles::Begin() {
  for (int c = 0; c < system_.equations.contacts(); ++c) {
    const ContactState& contact = system_.contacts[At(c)];
    turn_gradient_[At(c)].resize(0);
    system_.scales[At(c)] = {contact.largest_motion, contact.largest_speed};
    if (contact.phase == Phase::kResting) RaiseScale(c);
  }
}

bool Cycles::Run() const { return std::ranges::any_of(system_.contacts, IsRunning); }

bool Cycles::Wait() const {
  return std::ranges::any_of(system_.contacts,
                             [](const ContactState& c) { return c.phase == Phase::kStarting; });
}

void Cycles::KeepTurnGradient(int contact) {
  turn_gradient_[At(contact)] = system_.tangents.Work(contact);
}

void Cycles::Start(CycleHost& host, bool resting_only) {
  bool any = false;
  for (bool more = true; more;) {  // A collision may end the rest of others.
    more = false;
    for (int c = 0; c < system_.equations.contacts(); ++c) {
      const ContactState& contact = system_.contacts[At(c)];
      if (contact.phase != Phase::kStarting || (resting_only && !contact.settled)) continue;
      StartCycle(c, host);
      any = true;
      if (contact.cycle.kind != Cycle::Kind::kCollision) continue;
      StartPushed(c, host);
      for (const int disturbed : rest_.DisturbedBy(c)) {
        Wake(disturbed, host);
        more = true;
      }
    }
  }
  if (any) system_.RefreshActive();
}

// What touches the bodies of a collision at rest begins with it.
void Cycles::StartPushed(int collision, CycleHost& host) {
  const int n = system_.equations.bodies();
  for (int c = 0; c < system_.equations.contacts(); ++c) {
    ContactState& contact = system_.contacts[At(c)];
    const Sides& sides = system_.equations.sides(c);
    if (contact.phase != Phase::kOpen || !system_.equations.sides(collision).Pushes(sides)) {
      continue;
    }
    const double* y = system_.rk.y0.data();  // Which a cycle that starts may move.
    const bool at_rest = system_.Deformation(c, y) == 0 && sides.Relative(y + n) == 0;
    if (!at_rest || sides.Relative(system_.rk.slope0.data() + n) < 0) continue;
    contact.settled = false;
    contact.cycle.kind = Cycle::Kind::kNirv;
    StartCycle(c, host);
  }
}

void Cycles::StartCycle(int contact, CycleHost& host) {
  ContactState& state = system_.contacts[At(contact)];
  const bool touches = state.cycles == 0 || state.cycle.end == Cycle::End::kSeparation;
  if (touches) ++state.encounter;
  ++state.cycles;
  DescribeStart(contact);
  const CycleHost::Factor factor =
      host.OnStart(state, system_.equations.effective_mass(contact), ExternalForce(contact));
  state.cycle.mu = factor.mu;
  state.column = factor.column;
  state.phase = state.settled ? Phase::kResting : Phase::kCompression;
  if (state.settled) rest_.Begin(state, host);

  if (factor.column >= system_.tangents.count() && !system_.equations.recording) {
    system_.tangents.Add();
  }
  ResetWorks(contact);
  system_.tangents.Restart(contact);
  SetScale(contact, factor);
  if (state.cycle.kind == Cycle::Kind::kCollision) system_.touch_time = system_.time;
  ShiftAtJump(contact, 1);
  state.duration = ExpectedDuration(contact);
  if (state.woken && IsLetGo(contact)) Release(contact, host);
  if (state.settled) RaiseScale(contact);
  const double first = FirstStep(contact);
  system_.next_step = system_.next_step == 0 ? first : std::min(system_.next_step, first);
}

void Cycles::DescribeStart(int contact) {
  const double* y = system_.rk.y0.data();
  const int n = system_.equations.bodies();
  ContactState& state = system_.contacts[At(contact)];
  const bool collides = state.cycle.kind == Cycle::Kind::kCollision;
  const double deformation = collides ? 0 : std::max(0.0, system_.Deformation(contact, y));
  const double approach = collides ? std::max(0.0, system_.equations.Relative(contact, y + n)) : 0;
  state.cycle = {.contact = contact,
                 .number = state.cycles,
                 .kind = state.cycle.kind,
                 .start_time = system_.time,
                 .start_deformation = deformation,
                 .max_deformation = deformation,
                 .approach_velocity = approach};
  state.stored = ElasticEnergy(system_.scenario.contacts[At(contact)], deformation, state.yield);
  state.start_velocity = system_.equations.Relative(contact, y + n);
  state.released = false;
  state.imbalance = 0;
  state.peak = {};
}

// The external force [N] on a contact by its neighbours that are pressed, but whose cycles are
// still to begin at this instant: the equations know nothing of these yet.
double Cycles::ForceOfWaiting(int contact) const {
  const Sides& here = system_.equations.sides(contact);
  const std::vector<ActiveContact>& active = system_.equations.active;
  double acceleration = 0;
  for (int c = 0; c < system_.equations.contacts(); ++c) {
    const Sides& there = system_.equations.sides(c);
    const auto of_body = [&](std::ptrdiff_t body) {
      return (there.right == body ? there.right_inverse : 0) -
             (there.left == body ? there.left_inverse : 0);
    };
    const double response =
        here.left_counts * of_body(here.left) - here.right_counts * of_body(here.right);
    const ContactState& state = system_.contacts[At(c)];
    if (c == contact || response == 0 || state.phase == Phase::kOpen) continue;
    const double deformation = system_.Deformation(c, system_.rk.y0.data());
    const bool known = std::ranges::find(active, c, &ActiveContact::contact) != active.end();
    if (known || deformation <= 0) continue;
    acceleration +=
        response * SpringForce(system_.scenario.contacts[At(c)], deformation, state.yield).value;
  }
  return system_.equations.effective_mass(contact) * acceleration;
}

// Whether what pressed a contact that rested has plainly weakened.
bool Cycles::IsLetGo(int contact) const {
  const ContactState& state = system_.contacts[At(contact)];
  const double force = SpringForce(system_.scenario.contacts[At(contact)],
                                   state.cycle.start_deformation, state.yield)
                           .value;
  return ExternalForce(contact) + ForceOfWaiting(contact) < (1 - kLetGo) * force;
}

// The cycle gives back what was stored before it began: a restitution without compression.
void Cycles::Release(int contact, CycleHost& host) {
  ContactState& state = system_.contacts[At(contact)];
  const double mass = system_.equations.effective_mass(contact);
  state.cycle.mu = host.OnRelease(state, mass);
  state.released = true;
  state.column = kNone;
  system_.scales[At(contact)] = {state.cycle.start_deformation, std::sqrt(2 * state.stored / mass)};
  system_.RefreshActive();
}

double Cycles::ExternalForce(int contact) const {
  const int n = system_.equations.bodies();
  return system_.equations.effective_mass(contact) *
         system_.equations.Relative(contact, system_.rk.slope0.data() + n);
}

void Cycles::ResetWorks(int contact) {
  system_.rk.y0[system_.equations.work(contact)] = 0;
  if (system_.equations.recording) system_.rk.y0[system_.equations.external_work(contact)] = 0;
}

void Cycles::SetScale(int contact, const CycleHost::Factor& factor) {
  const Contact& c = system_.scenario.contacts[At(contact)];
  const Cycle& cycle = system_.contacts[At(contact)].cycle;
  const double approach = cycle.approach_velocity;
  MovingSystem::Scale& scale = system_.scales[At(contact)];
  scale = {factor.length, std::max(factor.speed, approach)};
  if (cycle.kind == Cycle::Kind::kNirv) return RaiseScale(contact);
  if (factor.length != 0) return;
  const double alpha = NeedsNoVelocity(c.damping) ? 0 : factor.mu * approach / c.stiffness;
  scale.length = MaximumDeformation(c, system_.equations.effective_mass(contact), approach, alpha);
}

// The scale of a swing by a part of the deformation with which the cycle began.
void Cycles::RaiseScale(int contact) {
  const ContactState& state = system_.contacts[At(contact)];
  const double deformation = state.cycle.start_deformation;
  const double stiffness =
      SpringForce(system_.scenario.contacts[At(contact)], deformation, state.yield).slope;
  const double rate = std::sqrt(stiffness / system_.equations.effective_mass(contact));
  MovingSystem::Scale& scale = system_.scales[At(contact)];
  const double length = kCompressedScale * deformation;
  scale.length = std::max(scale.length, length);
  scale.speed = std::max(scale.speed, length * rate);
}

// A small part of the cycle's duration, from the law's own scales.
double Cycles::FirstStep(int contact) const {
  const int n = system_.equations.bodies();
  const Contact& c = system_.scenario.contacts[At(contact)];
  const ContactState& state = system_.contacts[At(contact)];
  const Cycle& cycle = state.cycle;
  const double mass = system_.equations.effective_mass(contact);
  if (cycle.approach_velocity > 0) {
    const double v = cycle.approach_velocity;
    // In √t the error grows with the 9th power, t^4.5.
    return std::min(4 * std::pow(system_.tolerance, 2.0 / 9), 0.2) *
           MaximumDeformation(c, mass, v, 0) / v;
  }
  double deformation = cycle.start_deformation;
  if (deformation == 0) {  // The load's equilibrium.
    const double a = std::abs(system_.equations.Relative(contact, system_.rk.slope0.data() + n));
    deformation = DepthUnder(c, mass * a);
  }
  const double stiffness = SpringForce(c, deformation, state.yield).slope;
  return stiffness > 0 ? 0.1 / std::sqrt(stiffness / mass) : std::numeric_limits<double>::max();
}

// Three times the largest δ − δ_s over the largest |δ̇|: Hertz's elastic impact takes 2.94 of these,
// a swing about the load's equilibrium π. Damping makes it longer.
double Cycles::ExpectedDuration(int contact) const {
  const MovingSystem::Scale& scale = system_.scales[At(contact)];
  return scale.length > 0 && scale.speed > 0 ? 3 * scale.length / scale.speed : 0;
}

void Cycles::Apply(const StepEvents::Found& found, CycleHost& host) {
  ContactState& state = system_.contacts[At(found.contact)];
  const EventKind kind = found.event.kind;
  if (kind == EventKind::kTurn) {  // PassTurns has dealt with others.
    Yield(found.contact);
  } else if (kind == EventKind::kTouch || kind == EventKind::kRestTouch) {
    state.phase = Phase::kStarting;
    state.settled = false;
    state.cycle.kind = kind == EventKind::kTouch ? Cycle::Kind::kCollision : Cycle::Kind::kNirv;
  } else if (kind == EventKind::kRelease) {
    Release(found.contact, host);
    Turn(found.contact, system_.time, system_.rk.y0);
  } else if (DoesNothing(state, system_.time)) {
    CancelCycle(state, host);
  } else {
    const bool separates = kind == EventKind::kSeparation;
    EndCycle(state, separates ? Cycle::End::kSeparation : Cycle::End::kNonSeparation, host);
  }
}

// Ends the rest of a contact; its cycle is starting.
void Cycles::Wake(int contact, CycleHost& host) {
  ContactState& state = system_.contacts[At(contact)];
  if (state.cycle.start_time == system_.time) {  // It has not rested: there is no row of it.
    CancelCycle(state, host);
  } else {
    EndCycle(state, Cycle::End::kNonSeparation, host);
  }
  state.settled = false;
  state.woken = true;
}

void Cycles::AskRests(CycleHost& host) {
  for (int c = 0; c < system_.equations.contacts(); ++c) {
    ContactState& state = system_.contacts[At(c)];
    if (!Rests(state)) continue;
    state.rest_until = host.RestEnds(state);
    if (state.rest_until > system_.time) continue;
    if (state.phase == Phase::kResting) {
      Wake(c, host);
    } else {  // It was about to rest.
      state.settled = false;
      state.woken = true;
    }
  }
}

void Cycles::WakeDisturbed(bool at_breakpoint, CycleHost& host) {
  for (int c = 0; c < system_.equations.contacts(); ++c) {
    if (system_.contacts[At(c)].phase == Phase::kResting && rest_.Ends(c, at_breakpoint, host)) {
      Wake(c, host);
    }
  }
  if (!at_breakpoint) return;
  for (const int contact : rest_.DisturbedByLoads()) Wake(contact, host);
}

void Cycles::Turn(int contact, double time, const Eigen::ArrayXd& y) {
  ContactState& state = system_.contacts[At(contact)];
  state.phase = Phase::kRestitution;
  state.woken = false;
  state.cycle.turn_time = time;
  state.cycle.max_deformation = system_.Deformation(contact, y.data());
  SetCompression(system_.scenario.contacts[At(contact)], state.cycle.max_deformation,
                 y[system_.equations.work(contact)], system_.ExternalWork(contact, y), &state);
  KeepTurnGradient(contact);
}

// The contact turns as the step ends, and what it has been pressed by decides how it goes back.
void Cycles::Yield(int contact) {
  ContactState& state = system_.contacts[At(contact)];
  const double deformation = system_.Deformation(contact, system_.rk.y0.data());
  if (deformation > state.yield) {
    state.yield = deformation;
    system_.tangents.Yield(contact, system_.equations.sides(contact));
  }
  Turn(contact, system_.time, system_.rk.y0);
  system_.RefreshActive();
}

void Cycles::EndCycle(ContactState& state, Cycle::End end, CycleHost& host) {
  const int contact = state.cycle.contact;
  const bool separates = end == Cycle::End::kSeparation;
  state.cycle.end = end;
  if (state.phase == Phase::kResting) {
    DescribeRest(state);
  } else {
    DescribeEnd(state);
  }
  const Eigen::ArrayXd gradient = system_.tangents.Work(contact);
  // It has the μ that there were then; later ones begin at 0.
  Eigen::ArrayXd& turn = turn_gradient_[At(contact)];
  turn.conservativeResizeLike(Eigen::ArrayXd::Zero(gradient.size()));
  if (separates) ShiftAtJump(contact, -1);
  state.phase = separates ? Phase::kOpen : Phase::kStarting;
  if (separates) state.yield = 0;
  state.woken = false;
  state.last_mu = state.cycle.mu;
  const Cycle& cycle = state.cycle;  // Its scale may have been less than expected.
  const double length = std::max(cycle.max_deformation, cycle.start_deformation) -
                        std::min(cycle.start_deformation, cycle.end_deformation);
  host.OnEnd(state, turn, gradient - turn, length, system_.scales[At(contact)].speed);
  state.largest_work = std::max(state.largest_work, state.cycle.work_compression);
  state.cycle.kind = Cycle::Kind::kNirv;  // What follows a non-separation.
  ResetWorks(contact);
  system_.RefreshActive();
}

// The row of a rest tells the sum of its works, as those of one compression or restitution.
void Cycles::DescribeRest(ContactState& state) {
  const Eigen::ArrayXd& y = system_.rk.y0;
  const int contact = state.cycle.contact;
  const double deformation = std::max(0.0, system_.Deformation(contact, y.data()));
  SetRest(system_.scenario.contacts[At(contact)], system_.time, deformation,
          y[system_.equations.work(contact)], system_.ExternalWork(contact, y), &state);
  if (!system_.equations.recording) return;
  system_.contact_loss += state.cycle.dissipated_compression + state.cycle.dissipated_restitution;
}

void Cycles::DescribeEnd(ContactState& state) {
  Cycle& cycle = state.cycle;
  const Contact& contact = system_.scenario.contacts[At(cycle.contact)];
  const Eigen::ArrayXd& y = system_.rk.y0;
  const bool separates = cycle.end == Cycle::End::kSeparation;
  cycle.end_time = system_.time;
  cycle.turn_time = std::min(cycle.turn_time, cycle.end_time);  // The end was located again.
  cycle.end_deformation = separates ? 0 : system_.Deformation(cycle.contact, y.data());
  cycle.separation_velocity =
      separates ? system_.equations.Relative(cycle.contact, y.data() + system_.equations.bodies())
                : 0;
  const ContactState::Peak& peak = state.peak;
  const bool at_force = system_.splits_at_force() && !std::isnan(peak.time);
  if (at_force) {
    cycle.turn_time = peak.time;
    SetCompression(contact, peak.deformation, peak.work, peak.external_work, &state);
  }
  SetRestitution(contact, at_force ? peak.deformation : cycle.max_deformation,
                 y[system_.equations.work(cycle.contact)], system_.ExternalWork(cycle.contact, y),
                 &state);
  const double ratio = -cycle.work_restitution / cycle.work_compression;
  const bool told = cycle.work_compression > 0 && ratio >= 0 && !state.released;
  cycle.restitution_out = told ? std::sqrt(ratio) : kNaN;
  if (system_.equations.recording) Balance(state, at_force ? peak.velocity : 0);
}

// (W4), of a release to its end, and what the cycle has dissipated. A negligible cycle counts by
// what it does to the contact: of its own work round-off is left.
void Cycles::Balance(ContactState& state, double split_velocity) {
  Cycle& cycle = state.cycle;
  const double mass = system_.equations.effective_mass(cycle.contact);
  const auto kinetic = [&](double v) { return 0.5 * mass * v * v; };
  const double end =
      system_.equations.Relative(cycle.contact, system_.rk.y0.data() + system_.equations.bodies());
  const double compressed = cycle.work_compression - kinetic(state.start_velocity) +
                            kinetic(split_velocity) - cycle.external_compression;
  const double released = compressed - kinetic(split_velocity) + kinetic(end) +
                          cycle.work_restitution - cycle.external_restitution;
  const double work = state.released ? -cycle.work_restitution : cycle.work_compression;
  const double negligible = system_.scenario.solver.settled_nirv_fraction * state.largest_work;
  state.imbalance = std::abs(state.released ? released : compressed);
  if (state.imbalance > 0) {
    cycle.identity_residual = state.imbalance / (work > negligible ? work : state.largest_work);
  }
  system_.contact_loss += cycle.dissipated_compression + cycle.dissipated_restitution;
}

// Takes back a cycle that does nothing: a load parts touching bodies as their cycle begins. The
// next step is shorter, so that it does not see the same again.
void Cycles::CancelCycle(ContactState& state, CycleHost& host) {
  const int contact = state.cycle.contact;
  host.OnCancel(state);
  state.phase = state.cycle.start_deformation > 0 ? Phase::kStarting : Phase::kOpen;
  const bool opened = state.cycles == 1 || state.cycle.start_deformation == 0;
  if (opened) {  // There was no encounter: the next has its number.
    --state.encounter;
    state.cycle.end = Cycle::End::kSeparation;
  }
  --state.cycles;
  ResetWorks(contact);
  system_.next_step /= 2;
  system_.RefreshActive();
}

// (S3): where a force that is not 0 begins (sign 1) or ends (−1), a change of that instant changes
// the velocities after it.
void Cycles::ShiftAtJump(int contact, double sign) {
  const int n = system_.equations.bodies();
  const ContactState& state = system_.contacts[At(contact)];
  const ActiveContact c =
      system_.equations.Activate(contact, state.gap, state.cycle.mu, kNone, state.yield);
  const double rate = c.Relative(system_.rk.y0.data() + n);
  if (c.damping_exponent != 0 || rate == 0) return;
  system_.tangents.Jump(c, sign * c.At(0, rate).force / rate);
}

}  // namespace contact
