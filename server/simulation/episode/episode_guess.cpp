// The part of EpisodeSolver that guesses the first μ of a cycle, (N1) of README.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "simulation/episode/episode.h"

namespace contact {
namespace {

std::size_t At(int index) { return static_cast<std::size_t>(index); }

}  // namespace

// (N7) of the contact's last cycle, or of one next to it that has the same law.
double EpisodeSolver::NearestNatural(int contact) const {
  const auto count = static_cast<int>(natural_.size());
  for (int away = 0; away < count; ++away) {
    for (const int other : {contact - away, contact + away}) {
      if (other < 0 || other >= count || !(natural_[At(other)] > 0)) continue;
      return natural_[At(other)];
    }
  }
  return 0;
}

// (N1), or (N7) as soon as a pass has seen the cycle or another one of its contact.
double EpisodeSolver::FirstFactor(const Unknown& u, const ContactState& state,
                                  double effective_mass, double external_force) {
  if (careful_ && u.iterated) {
    if (u.natural_mu > 0) return u.natural_mu;
    if (const double natural = NearestNatural(u.contact); natural > 0) return natural;
  }
  return StartFactor(state, effective_mass, external_force);
}

double EpisodeSolver::StartFactor(const ContactState& state, double effective_mass,
                                  double external_force) {
  const Cycle& cycle = state.cycle;
  const Contact& contact = scenario_.contacts[At(cycle.contact)];
  if (contact.damping == DampingLaw::kGiven) return contact.mu;
  if (NeedsNoVelocity(contact.damping)) {
    return DampingFactor(contact.damping, contact.restitution, contact.stiffness, effective_mass);
  }
  const double alpha = DampingCoefficient(contact.damping, contact.restitution);
  const double own =
      contact.reference_velocity > 0 ? contact.reference_velocity : cycle.approach_velocity;
  if (contact.damping != DampingLaw::kEnergyRestitution) {
    if (own > 0) return alpha * contact.stiffness / own;
    WarnOnce(contact,
             "has a cycle that starts at rest, for which its law has no approach "
             "velocity; it keeps the last μ (0 before the first). "
             "Give reference_velocity_m_per_s");
    return std::isnan(state.last_mu) ? 0 : state.last_mu;
  }
  if (alpha == 0) return 0;  // ε = 1.
  if (as_paper_) return PaperStartFactor(state, contact, own);
  if (own == 0 && state.last_mu > 0) return state.last_mu;
  if (const double speed = std::max(own, careful_ ? 0 : NeighbourSpeed(cycle.contact)); speed > 0) {
    return alpha * contact.stiffness / speed;
  }
  if (reference_speed_ > 0) return alpha * contact.stiffness / reference_speed_;
  // At rest under a load: the speed with which it swings through its equilibrium.
  const double depth =
      std::pow(std::max(external_force, 0.0) / contact.stiffness, 1 / contact.exponent);
  const double stiffness = contact.stiffness * Power(depth, contact.exponent).slope;
  const double speed = depth * std::sqrt(stiffness / effective_mass);
  return speed > 0 ? alpha * contact.stiffness / speed : alpha * contact.stiffness;
}

// The neighbour of a contact, other than `except`, whose first cycle is the last begun.
int EpisodeSolver::Neighbour(int contact, int except) const {
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
double EpisodeSolver::NeighbourSpeed(int contact) const {
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
