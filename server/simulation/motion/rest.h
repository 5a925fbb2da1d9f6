#pragma once

#include <vector>

#include "simulation/motion/cycle_host.h"
#include "simulation/motion/moving_system.h"

namespace contact {

/// Whether the work of a contact that rests, or did so until its cycle began, is negligible so far,
/// at this deformation [m].
bool HardlyWorks(const MovingSystem& system, int contact, double deformation);

/// When contacts that rest do so no more. README.md, I8.
///
/// Rest ends at its cause: a collision, or a load that begins or ends, at bodies that closed
/// contacts and supports join to those of the contact. Where the loads change smoothly it is seen
/// late that a contact no longer rests; its rest should have ended at the last instant with δ̇ = 0
/// at which its work was still negligible, or at the last breakpoint of a load. The host is told of
/// that instant, and may have the motion begun anew.
class Rest {
 public:
  /// The system must outlive this.
  explicit Rest(MovingSystem& system) : system_(system) {}

  /// The rest of a contact begins.
  void Begin(ContactState& state, CycleHost& host);
  /// The next instant at which a rest is known to end [s].
  double NextEnd() const;
  /// Looks at the step, which is accepted, for instants at which rests may end.
  void Follow();
  /// Whether the step has ended the rest of a contact.
  bool Ends(int contact, bool at_breakpoint, CycleHost& host);
  /// The contacts whose rest a collision ends that begins now.
  std::vector<int> DisturbedBy(int collision) const;
  /// The contacts whose rest the loads end that begin or end now.
  std::vector<int> DisturbedByLoads() const;

 private:
  /// Whether what pressed it is gone, however little that stored: it is let go at once.
  bool IsLeft(int contact, double deformation) const;
  /// A quantity of each body, summed over those that closed contacts and supports join.
  std::vector<double> Spread(std::vector<double> of_bodies) const;
  /// Those resting contacts that a displacement [m], by the stiffness of the contact, disturbs.
  template <class Displacement>
  std::vector<int> Disturbed(const std::vector<double>& of_bodies, Displacement by) const;

  MovingSystem& system_;
};

}  // namespace contact
