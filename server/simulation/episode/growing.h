#pragma once

#include <map>

#include "simulation/episode/bisection.h"
#include "simulation/episode/iteration_log.h"
#include "simulation/episode/problem.h"

namespace contact {

/// Lets groups take in their neighbours where no μ of theirs is a solution, and says what became of
/// those that cannot grow.
class Growing {
 public:
  Growing(Problem& problem, IterationLog& log, Bisection& bisection)
      : problem_(problem), log_(log), bisection_(bisection) {}

  /// A search begins, of which nothing is known but the groups.
  void Begin() { scanned_.clear(), scanned_below_.clear(); }

  /// Grows the group for what bisection has found, or finds that the run cuts it. False: it cannot
  /// grow, or may not.
  bool Answer(const GroupSight& group, Root root);
  /// Says of a group that cannot grow what it is.
  void Decide(const GroupId& id, Root root) const;
  /// Grows a group for lack of progress; where it cannot grow it is given up.
  void Force(const GroupId& id);
  /// Takes up again a group that begins `before` [s] and was found to have no solution, where that
  /// does not hold with what is now around it. False: there is none.
  bool Reopen(const Sight& scan, double before = kForever);
  /// Says of a group that did not end in a scan that it is unfinished. False: there is none.
  bool Close(const Sight& scan);

 private:
  bool Holds(const GroupSight& group, const Group::Reached& side, double sign);
  // Σμ of all with which groups were scanned last.
  using Scanned = std::map<GroupId, double>;
  static bool IsNew(const GroupSight& group, const Sight& scan, Scanned* scanned);
  bool MayHaveLess(const GroupSight& group) const;
  static std::ptrdiff_t Overlapping(const GroupSight& group, const Sight& scan);
  bool HasLess(const GroupSight& group, const Sight& scan);
  bool IsCut(const GroupId& id);
  bool Grow(const GroupId& id, Growth why);
  bool TakeNext(const GroupId& id, Growth why);
  bool JoinPrevious(const GroupId& id, Growth why);
  static bool Settles(const GroupSight& group, const GroupSight& neighbour, Growth why);

  Problem& problem_;
  IterationLog& log_;
  Bisection& bisection_;
  Scanned scanned_, scanned_below_;  // For any root, for a smaller one.
};

}  // namespace contact
