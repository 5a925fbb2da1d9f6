#pragma once

#include <functional>
#include <string>
#include <vector>

#include "simulation/model/scenario.h"
#include "simulation/motion/motion.h"

namespace contact {

/// The μ with which a cycle is tried first, (N1) of README.md, or which its law gives.
class FirstGuess {
 public:
  FirstGuess(const Scenario& scenario, const Motion& motion);

  /// A pass begins.
  void Begin() { fastest_ = 0; }
  /// A cycle starts with this approach velocity [m/s].
  void Observe(double approach_velocity);

  /// μ for a cycle of this contact that starts now; `external_force` is F_e [N]. NaN: its law has
  /// no approach velocity, and the contact keeps the μ it had.
  double Factor(const ContactState& state, double effective_mass, double external_force) const;

  /// μ of a cycle that gives back what was stored before it: that of the isolated collision which
  /// would have brought the contact to its δ_s.
  double Released(const ContactState& state, double effective_mass) const;

 private:
  double Sought(const ContactState& state, double alpha, double own_speed, double effective_mass,
                double external_force) const;
  // How far apart the two sides of a contact are [m], and how fast they approach [m/s].
  struct Meeting {
    double gap, speed;
  };
  Meeting MeetingOf(int contact) const;
  double OwnDepth(const Cycle& cycle, double effective_mass) const;
  double SpeedAround(const Cycle& cycle, double effective_mass) const;
  double FastestBody() const;
  double SpeedBehind(const Cycle& cycle, double effective_mass) const;
  double SwingAhead(const Cycle& cycle, double effective_mass, double external_force) const;
  double LoadChange(const Contact& contact, double time) const;
  double Paper(const ContactState& state, double own_speed) const;
  int Neighbour(int contact, int except) const;
  double NeighbourSpeed(int contact) const;

  const Scenario& scenario_;
  const Motion& motion_;
  double fastest_ = 0;  // Largest approach velocity in the pass.
};

}  // namespace contact
