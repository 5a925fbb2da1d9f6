#include "simulation/episode/first_guess.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "simulation/laws/isolated_collision.h"
#include "simulation/model/derived.h"
#include "simulation/model/index.h"

namespace contact {
namespace {

// Part of the speed of a swing about the load that a guess reckons with at least: a μ that is too
// large lets a loaded contact creep without end.
constexpr double kSwing = 0.3;
// How long a collision takes, in units of δ_m/v: three of them, and longer where it is damped.
constexpr double kAlone = 6;
// A speed is nothing beside one that is so many times it. Touching bodies of almost one speed meet
// with 1e-7 of the others' and less (nearspeeds of the machines).
constexpr double kFarSlower = 1e5;
// Times after which loads are looked at: each is a fourth of the next, from 1e-12 of what is left.
constexpr double kFiner = 0.25;
constexpr int kFinest = 20;

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
  if (IsGiven(contact.damping)) return contact.mu;
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
  if (RowOf(c.damping).scale != DampingScale::kVelocity) return Factor(state, effective_mass, 0);
  if (state.cycle.start_deformation == 0) return state.cycle.mu;  // It ends at once with any μ.
  const double alpha = DampingCoefficient(c.damping, c.restitution);
  // What has rested has no velocity; what is pressed at t = 0 may.
  const double velocity = state.cycle.number == 1 ? state.start_velocity : 0;
  return alpha * c.stiffness /
         ApproachVelocity(effective_mass, state.cycle.start_deformation, velocity, c.stiffness,
                          c.exponent, alpha);
}

double FirstGuess::Sought(const ContactState& state, double alpha, double own,
                          double effective_mass, double external_force) const {
  const Contact& contact = scenario_.contacts[At(state.cycle.contact)];
  if (own == 0 && state.last_mu > 0 && !state.woken) return state.last_mu;
  double speed = std::max(
      {own, NeighbourSpeed(state.cycle.contact), SpeedAround(state.cycle, effective_mass)});
  if (own > 0 && 2 * FastestBody() > kFarSlower * speed) {
    const double behind = SpeedBehind(state.cycle, effective_mass);
    if (behind > kFarSlower * speed) speed = behind;
  }
  if (speed == 0) speed = fastest_;
  const double swing = std::max(SwingSpeed(contact, effective_mass, external_force),
                                SwingAhead(state.cycle, effective_mass, external_force));
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
  const double reach = kAlone * OwnDepth(cycle, effective_mass) / own;
  double largest = 0;
  for (int c = 0; c < motion_.equations().contacts(); ++c) {
    const Contact& there = scenario_.contacts[At(c)];
    const bool shares = (here.left != kNone && here.left == there.right) ||
                        (here.right != kNone && here.right == there.left);
    if (!shares) continue;
    const Meeting meeting = MeetingOf(c);
    if (meeting.speed > own && meeting.gap <= reach * meeting.speed) {
      largest = std::max(largest, meeting.speed);
    }
  }
  return largest;
}

double FirstGuess::FastestBody() const {
  const int n = motion_.equations().bodies();
  return motion_.integrator().y0.segment(n, n).abs().maxCoeff();
}

// The largest speed with which bodies meet that push a collision through contacts which touch.
double FirstGuess::SpeedBehind(const Cycle& cycle, double effective_mass) const {
  const double reach = kAlone * OwnDepth(cycle, effective_mass) / cycle.approach_velocity;
  std::vector<bool> joined(scenario_.bodies.size());
  double largest = 0;
  const auto join = [&](int contact) {
    const Contact& c = scenario_.contacts[At(contact)];
    for (const int body : {c.left, c.right}) {
      if (body != kNone) joined[At(body)] = true;
    }
  };
  const auto look = [&](int contact) {
    const Contact& c = scenario_.contacts[At(contact)];
    const Meeting meeting = MeetingOf(contact);
    const bool joins =
        (c.left != kNone && joined[At(c.left)]) || (c.right != kNone && joined[At(c.right)]);
    if (!joins || meeting.gap > reach * std::abs(meeting.speed)) return;
    join(contact);
    largest = std::max(largest, meeting.speed);
  };
  join(cycle.contact);
  const int contacts = motion_.equations().contacts();
  for (int c = 0; c < contacts; ++c) look(c);
  for (int c = contacts; c-- > 0;) look(c);
  return largest;
}

double FirstGuess::OwnDepth(const Cycle& cycle, double effective_mass) const {
  const Contact& c = scenario_.contacts[At(cycle.contact)];
  return MaximumDeformation(effective_mass, cycle.approach_velocity, c.stiffness, c.exponent, 0);
}

FirstGuess::Meeting FirstGuess::MeetingOf(int contact) const {
  const double* y = motion_.integrator().y0.data();
  const Equations& equations = motion_.equations();
  return {.gap = -motion_.Deformation(contact, y),
          .speed = equations.Relative(contact, y + equations.bodies())};
}

// The speed of the swing through the equilibrium of the loads as they will be while the cycle
// lasts: what begins slowly may be pushed together by what grows meanwhile. A collision is the
// sooner over, the faster it is; how long a cycle from rest lasts is not known, and too small a μ
// does no harm. Loads that do not change at once are taken as they are: a guess needs no more.
double FirstGuess::SwingAhead(const Cycle& cycle, double effective_mass,
                              double external_force) const {
  const Contact& c = scenario_.contacts[At(cycle.contact)];
  const double own = cycle.approach_velocity, left = scenario_.end_time - motion_.time();
  double fastest = 0;
  for (double time = left * std::pow(kFiner, kFinest); time < left; time /= kFiner) {
    const double change = effective_mass * LoadChange(c, time);
    if (change == 0) return fastest;
    fastest = std::max(fastest, SwingSpeed(c, effective_mass, external_force + change));
    if (own == 0) continue;
    const double v = std::max(own, fastest);
    const double depth = MaximumDeformation(effective_mass, v, c.stiffness, c.exponent, 0);
    if (0.5 * kAlone * depth <= v * time) break;
  }
  return fastest;
}

// By how much loads and drives will accelerate the bodies of a contact together after this time,
// more than now.
double FirstGuess::LoadChange(const Contact& contact, double time) const {
  const double now = motion_.time();
  double change = 0;
  const auto see = [&](const auto& pieces, auto value, auto mass) {
    for (const auto& row : pieces.rows()) {
      const int body = row.front().body;
      const double sign = body == contact.left ? 1 : body == contact.right ? -1 : 0;
      if (sign == 0) continue;
      const auto at = [&](double t) {
        const auto* piece = pieces.At(row, t);
        return piece == nullptr ? 0 : value(*piece, t);
      };
      change += sign * (at(now + time) - at(now)) / mass(body);
    }
  };
  see(motion_.equations().loads(), LoadForce,
      [this](int body) { return scenario_.bodies[At(body)].mass; });
  see(
      motion_.equations().drives(),
      [](const Drive& drive, double t) { return MotionAt(drive, t).acceleration; },
      [](int) { return 1.0; });
  return change;
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
