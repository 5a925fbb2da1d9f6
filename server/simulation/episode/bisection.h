#pragma once

#include "simulation/episode/problem.h"

namespace contact {

/// What bisection finds of a group: a root, or that there is none.
enum class Root {
  kFound,
  kTooLittle,  ///< Even without damping too little comes back.
  kTooMuch,    ///< Too much comes back up to a damping that the contact can feel no more, or with
               ///< which it does not end.
  kJump,       ///< What comes back jumps over what is asked for.
  kAborted,    ///< See Problem::Aborted.
};

/// Bisection of the μ of one group, with those of all others held. Keeps in the group's Unknown the
/// nearest μ on both sides, and sets its μ to the root, or to the side of a jump that is nearer.
class Bisection {
 public:
  explicit Bisection(Problem& problem) : problem_(problem) {}

  /// `near`: a root misses by less, relative, in ε²; at most what Newton needs to go on.
  Root Solve(const GroupSight& group, double near);
  /// Whether the group has a root anywhere: ε may rise and fall with μ, so that a bracket that has
  /// none need not be the only one. Sets its μ to the root.
  bool Scan(const GroupSight& group);
  /// Whether a group that its μ solves has a smaller root. Sets its μ to the smallest; where there
  /// is none, nothing changes.
  bool ScanBelow(const GroupSight& group);

 private:
  struct Point {
    double mu = 0;
    double excess = 0;  // ε_out²/ε_in² − 1; of what does not end −1.
    double slope = 0;   // Of the excess, by μ; 0: unknown.
    double most = 0;    // See Problem::MostMu.
    double end = 0;     // Of the group [s].
    bool there = true;
    bool ended = true;
  };
  Point At(double mu, bool slope = false);
  bool HasRoot(const Point& from, const Point& to);
  bool HasRootIn(const Point& from, const Point& to);
  bool Falls(const Point& undamped) const;
  Root Look();
  Root Exactly(Root root);
  bool IsRoot(const Point& point) const;
  bool Confirmed(Root root);
  bool Holds();
  bool HasNone() const;
  bool PartsTroughs() const;
  Root Bracket();
  void Approach(const Point& first);
  Root Narrow();
  void Keep(const Point& point);
  Root Finish(Root root);

  Problem& problem_;
  GroupSight group_;   // As first seen.
  double near_ = 0;    // The excess of a root.
  double until_ = 0;   // What has not ended then is open [s].
  double below_ = 0;   // A scan looks for a root below this μ.
  double error_ = 0;   // Relative error of a pass; 0: as little as the scenario asks.
  Point more_, less_;  // Nearest μ with too much, too little.
  double fall_ = 0;    // Of what is too much, over the last change of its μ.
};

}  // namespace contact
