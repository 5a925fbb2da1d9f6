#include "simulation/motion/rest.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "simulation/model/contact_spring.h"
#include "simulation/model/derived.h"
#include "simulation/model/index.h"

namespace contact {
namespace {

// A contact rests no more when the work of its spring or the energy of its motion is this many
// times what lets it settle, or when this part of its force is gone: with the μ of its last bounce
// a floor holds what leaves it like glue. Machines.RestNoMoreWhereTheyMove.
constexpr double kWakeFactor = 4, kGone = 0.5;
// Part of that work up to which what comes may be its cause.
constexpr double kNegligible = 1.0 / 16;

// The force of a contact at a deformation, and its slope.
Power Stress(const MovingSystem& system, int contact, double deformation) {
  return SpringForce(system.scenario.contacts[At(contact)], deformation,
                     system.contacts[At(contact)].yield);
}

// The work that ends the rest of a contact [J].
double WakingWork(const MovingSystem& system, const ContactState& state) {
  return kWakeFactor * system.scenario.solver.settled_nirv_fraction * state.largest_work;
}

// An energy in units of the work that ends the rest of a contact.
double PartOfWaking(const MovingSystem& system, int contact, double energy) {
  const double limit = WakingWork(system, system.contacts[At(contact)]);
  return limit > 0 ? energy / limit : 0;
}

// What the spring of a contact has worked since its cycle began, at most, at this deformation [J].
double SpringWork(const MovingSystem& system, int contact, double deformation) {
  const double moved = deformation - system.contacts[At(contact)].cycle.start_deformation;
  return Stress(system, contact, deformation).value * std::abs(moved);
}

// With what energy the two bodies of a contact move against each other [J].
double MotionEnergy(const MovingSystem& system, int contact) {
  const double rate =
      system.equations.Relative(contact, system.rk.y0.data() + system.equations.bodies());
  return 0.5 * system.equations.effective_mass(contact) * rate * rate;
}

}  // namespace

bool HardlyWorks(const MovingSystem& system, int contact, double deformation) {
  const double work = SpringWork(system, contact, deformation);
  return PartOfWaking(system, contact, work) <= kNegligible;
}

void Rest::Begin(ContactState& state, CycleHost& host) {
  state.rest_mark = system_.time;
  state.rest_until = host.RestEnds(state);
}

double Rest::NextEnd() const {
  double next = kNever;
  if (!system_.resting) return next;
  for (const ContactState& state : system_.contacts) {
    const bool rests = state.phase == Phase::kResting && state.rest_until > system_.time;
    if (rests) next = std::min(next, state.rest_until);
  }
  return next;
}

bool Rest::IsLeft(int contact, double deformation) const {
  const double start = system_.contacts[At(contact)].cycle.start_deformation;
  return Stress(system_, contact, deformation).value <
         kGone * Stress(system_, contact, start).value;
}

// Where δ̇ changes its sign, as long as what has happened since the rest began is negligible.
void Rest::Follow() {
  const int n = system_.equations.bodies();
  for (const ActiveContact& active : system_.equations.active) {
    ContactState& state = system_.contacts[At(active.contact)];
    if (state.phase != Phase::kResting) continue;
    const double before = active.Relative(system_.rk.y0.data() + n);
    const double after = active.Relative(system_.rk.y1.data() + n);
    const double deformation = active.Relative(system_.rk.y1.data()) - active.gap;
    const bool turns = (before > 0) != (after > 0);
    if (!turns || !HardlyWorks(system_, active.contact, deformation)) continue;
    state.rest_mark = system_.time + system_.step.h * before / (before - after);
  }
}

bool Rest::Ends(int contact, bool at_breakpoint, CycleHost& host) {
  ContactState& state = system_.contacts[At(contact)];
  if (system_.time >= state.rest_until) return true;
  const double deformation = system_.Deformation(contact, system_.rk.y0.data());
  const double most =
      std::max(SpringWork(system_, contact, deformation), MotionEnergy(system_, contact));
  const double disturbance = PartOfWaking(system_, contact, most);
  if (at_breakpoint && disturbance <= kNegligible) state.rest_mark = system_.time;
  return disturbance > 1 ? host.OnDisturbed(state, state.rest_mark) : IsLeft(contact, deformation);
}

std::vector<double> Rest::Spread(std::vector<double> of_bodies) const {
  const Equations& equations = system_.equations;
  const auto join = [&](const Sides& sides) {
    if (sides.left_inverse == 0 || sides.right_inverse == 0) return false;
    double& left = of_bodies[static_cast<std::size_t>(sides.left)];
    double& right = of_bodies[static_cast<std::size_t>(sides.right)];
    if (left == right) return false;
    left = right = std::max(left, right);
    return true;
  };
  for (bool more = true; more;) {
    more = false;
    for (int c = 0; c < equations.contacts(); ++c) {
      const ContactState& state = system_.contacts[At(c)];
      if (state.phase != Phase::kOpen) more |= join(equations.sides(c));
    }
    for (const Support& s : system_.scenario.supports) {
      more |= join(equations.SidesOf(s.body, s.other));
    }
  }
  return of_bodies;
}

template <class Displacement>
std::vector<int> Rest::Disturbed(const std::vector<double>& of_bodies, Displacement by) const {
  std::vector<int> disturbed;
  for (int c = 0; c < system_.equations.contacts(); ++c) {
    const ContactState& state = system_.contacts[At(c)];
    if (state.phase != Phase::kResting || state.cycle.start_time == system_.time) continue;
    const Sides& sides = system_.equations.sides(c);
    const double cause =
        std::max(sides.left_counts * of_bodies[static_cast<std::size_t>(sides.left)],
                 sides.right_counts * of_bodies[static_cast<std::size_t>(sides.right)]);
    const Power stress = Stress(system_, c, state.cycle.start_deformation);
    const double moved = by(cause, stress.slope);
    const double work = (stress.value + 0.5 * stress.slope * moved) * moved;
    if (work > WakingWork(system_, state)) disturbed.push_back(c);
  }
  return disturbed;
}

std::vector<int> Rest::DisturbedBy(int collision) const {
  if (!system_.resting) return {};
  const double mass = system_.equations.effective_mass(collision);
  const double speed = system_.contacts[At(collision)].cycle.approach_velocity;
  std::vector<double> speeds(system_.scenario.bodies.size());
  const Contact& c = system_.scenario.contacts[At(collision)];
  for (const int body : {c.left, c.right}) {
    if (body != kNone) speeds[At(body)] = speed;
  }
  return Disturbed(Spread(std::move(speeds)),
                   [&](double v, double stiffness) { return v * std::sqrt(mass / stiffness); });
}

std::vector<int> Rest::DisturbedByLoads() const {
  if (!system_.resting) return {};
  std::vector<double> forces(system_.scenario.bodies.size());
  const double t = system_.time;
  for (const std::span<const Load> row : system_.equations.loads().rows()) {
    const auto begun = PieceRows<Load>::Begun(row, t);
    for (const Load& load : begun.last(std::min<std::size_t>(begun.size(), 2))) {
      if (load.begin == t) forces[At(load.body)] += LoadForce(load, t);
      if (load.end == t) forces[At(load.body)] -= LoadForce(load, t);
    }
  }
  for (double& force : forces) force = std::abs(force);
  return Disturbed(Spread(std::move(forces)),
                   [](double force, double stiffness) { return force / stiffness; });
}

}  // namespace contact
