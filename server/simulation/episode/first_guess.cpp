#include "simulation/episode/first_guess.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "simulation/laws/isolated_collision.h"

namespace contact {
namespace {

// Part of the speed of a swing about the load that a guess reckons with at least: a μ that is too
// large lets a loaded contact creep without end.
constexpr double kSwing = 0.3;
// How long a collision takes, in units of δ_m/v: three of them, and longer where it is damped.
constexpr double kAlone = 6;

std::size_t At(int index) { return static_cast<std::size_t>(index); }

// The speed with which a contact swings through the equilibrium of a load, ω δ_eq.
double SwingSpeed(const Contact& contact, double effective_mass, double force) {
  const double depth = std::pow(std::max(force, 0.0) / contact.stiffness, 1 / contact.exponent);
  const double stiffness = contact.stiffness * Power(depth, contact.exponent).slope;
  return depth * std::sqrt(stiffness / effective_mass);
}

}  // namespace

FirstGuess::FirstGuess(const Scenario& scenario, const Motion& motion)
    : scenario_(scenario), motion_(motion) {}

void FirstGuess::Observe(double approach_velocity) {
  fastest_ = std::max(fastest_, approach_velocity);
}

double FirstGuess::Factor(const ContactState& state, double effective_mass,
                          double external_force) const {
  const Cycle& cycle = state.cycle;
  const Contact& contact = scenario_.contacts[At(cycle.contact)];
  if (contact.damping == DampingLaw::kGiven) return contact.mu;
  if (NeedsNoVelocity(contact.damping)) {
    return DampingFactor(contact.damping, contact.restitution, contact.stiffness, effective_mass);
  }
  const double alpha = DampingCoefficient(contact.damping, contact.restitution);
  const double own =
      contact.reference_velocity > 0 ? contact.reference_velocity : cycle.approach_velocity;
  if (contact.damping == DampingLaw::kEnergyRestitution) {
    if (alpha == 0) return 0;  // ε = 1.
    if (scenario_.solver.update != UpdateRule::kNewtonCoupled) return Paper(state, own);
    return Sought(state, alpha, own, effective_mass, external_force);
  }
  return own > 0 ? alpha * contact.stiffness / own : kNaN;
}

double FirstGuess::Released(const ContactState& state, double effective_mass) const {
  const Contact& c = scenario_.contacts[At(state.cycle.contact)];
  if (c.damping == DampingLaw::kGiven || NeedsNoVelocity(c.damping)) return state.cycle.mu;
  const double alpha = DampingCoefficient(c.damping, c.restitution);
  return alpha * c.stiffness /
         ApproachVelocity(effective_mass, state.cycle.start_deformation, c.stiffness, c.exponent,
                          alpha);
}

double FirstGuess::Sought(const ContactState& state, double alpha, double own,
                          double effective_mass, double external_force) const {
  const Contact& contact = scenario_.contacts[At(state.cycle.contact)];
  if (own == 0 && state.last_mu > 0 && !state.woken) return state.last_mu;
  double speed = std::max(
      {own, NeighbourSpeed(state.cycle.contact), SpeedAround(state.cycle, effective_mass)});
  if (speed == 0) speed = fastest_;
  const double swing = SwingSpeed(contact, effective_mass, external_force);
  speed = speed > 0 ? std::max(speed, kSwing * swing) : swing;
  const double mu = alpha * contact.stiffness / (speed > 0 ? speed : 1);
  return state.woken && state.last_mu > 0 ? std::min(mu, state.last_mu) : mu;
}

// The largest speed with which the bodies of a collision meet others in the time that the collision
// would take alone: what those push it by is no matter of its own speed.
double FirstGuess::SpeedAround(const Cycle& cycle, double effective_mass) const {
  const double own = cycle.approach_velocity;
  if (own == 0) return 0;
  const Contact& here = scenario_.contacts[At(cycle.contact)];
  const double depth = MaximumDeformation(effective_mass, own, here.stiffness, here.exponent, 0);
  const double* y = motion_.integrator().y0.data();
  const Equations& equations = motion_.equations();
  double largest = 0;
  for (int c = 0; c < equations.contacts(); ++c) {
    const Contact& there = scenario_.contacts[At(c)];
    const bool shares = (here.left != kNone && here.left == there.right) ||
                        (here.right != kNone && here.right == there.left);
    const double speed = equations.Relative(c, y + equations.bodies());
    const double gap = -motion_.Deformation(c, y);
    if (shares && speed > own && gap * own <= kAlone * depth * speed) {
      largest = std::max(largest, speed);
    }
  }
  return largest;
}

// Paper (23); for a cycle from rest the last μ or paper (28), which hides a velocity of 1 m/s.
double FirstGuess::Paper(const ContactState& state, double own) const {
  if (own == 0 && state.last_mu > 0) return state.last_mu;
  const Contact& contact = scenario_.contacts[At(state.cycle.contact)];
  const double alpha = DampingCoefficient(DampingLaw::kPaperEq23, contact.restitution);
  return alpha * contact.stiffness / (own > 0 ? own : 1);
}

// The neighbour of a contact, other than `except`, whose first cycle is the last begun.
int FirstGuess::Neighbour(int contact, int except) const {
  const Contact& here = scenario_.contacts[At(contact)];
  int last = kNone;
  for (const ContactState& state : motion_.contacts()) {
    const int c = state.cycle.contact;
    if (state.cycles != 1 || c == contact || c == except) continue;
    const Contact& other = scenario_.contacts[At(c)];
    const bool shares = (here.left != kNone && here.left == other.right) ||
                        (here.right != kNone && here.right == other.left);
    const bool iterated = other.damping == DampingLaw::kEnergyRestitution && state.cycle.mu > 0;
    if (!shares || !iterated) continue;
    if (last == kNone || state.cycle.start_time > motion_.contacts()[At(last)].cycle.start_time) {
      last = c;
    }
  }
  return last;
}

// The approach velocity that an isolated collision would have with the μ to which those of the
// neighbours lead, one of which pushes; 0 without. A pulse in a row weakens by less and less from
// contact to contact: 1/ln(v_i/v_(i+1)) grows about linearly.
double FirstGuess::NeighbourSpeed(int contact) const {
  std::array<double, 3> logarithm;  // Of the speeds of the last three, the last first.
  std::size_t known = 0;
  int behind = kNone, here = contact;
  for (; known < logarithm.size(); ++known) {
    const int next = Neighbour(here, behind);
    if (next == kNone) break;
    const ContactState& state = motion_.contacts()[At(next)];
    const bool pushes = state.phase == Phase::kCompression || state.phase == Phase::kRestitution;
    if (known == 0 && !pushes) break;
    behind = std::exchange(here, next);
    const Contact& there = scenario_.contacts[At(next)];
    logarithm[known] =
        std::log(ExactCoefficient(there.restitution) * there.stiffness / state.cycle.mu);
  }
  if (known == 0) return 0;
  double change = 0;
  if (known == 3) {
    const double last = logarithm[0] - logarithm[1], before = logarithm[1] - logarithm[2];
    const bool fades = last * before > 0 && std::abs(last) < std::abs(before);
    if (fades) change = 1 / (2 / last - 1 / before);
  }
  return std::exp(logarithm[0] + change);
}

}  // namespace contact
