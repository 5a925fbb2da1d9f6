#pragma once

#include "simulation/episode/groups.h"

namespace contact {

/// How many cycles are solved together: later cycles act on earlier ones, but less and less. A
/// group whose μ no longer changes when the window takes in more cycles is final; (N6) of
/// README.md.
class Window {
 public:
  /// Of an episode that begins at `start` [s] while so many cycles run; `known` groups have
  /// their μ from an earlier search. `longest`: cycles that a group may have at first.
  void Begin(double start, int running, int known, int contacts, int longest);
  int cycles() const { return cycles_; }

  /// Looks at a pass in whose window every group has its answer: returns the instant [s] up to
  /// which all that begins is final, at most `end`. If none is the window grows, and it is the
  /// start.
  double FinalUntil(const Sight& sight, Groups& groups, double tolerance, double end);

 private:
  bool Foreseen(const GroupSight& group, const Sight& sight) const;
  bool IsFinal(const GroupSight& group, const Sight& sight, Groups& groups, double change) const;

  double start_ = 0;
  int cycles_ = 0, most_ = 0;
};

}  // namespace contact
