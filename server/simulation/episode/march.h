#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "simulation/episode/bisection.h"
#include "simulation/episode/block.h"
#include "simulation/episode/growing.h"
#include "simulation/episode/timeline.h"

namespace contact {

/// Instants so near, relative to the episode, are one: round-off parts them.
inline constexpr double kAtOnce = 1e-9;

/// The search as a march in the order in which groups end: what a group misses depends only on
/// groups that begin before it ends, so the first that misses is solved with the solved ones that
/// overlap it, and the next pass goes on from there. README.md, "Finding μ".
class March {
 public:
  /// How a search has ended.
  struct End {
    Motion::Pause pause = Motion::Pause::kQuiet;  ///< Why a pass could not be completed, or kQuiet.
    double until = kNever;   ///< What begins before has its answer, and may be recorded [s].
    bool tentative = false;  ///< All seems to be solved: its recording will tell.
    Sight sight = {};        ///< The pass that shows the answers.
  };

  March(Problem& problem, IterationLog& log, Growing& growing, Bisection& bisection)
      : problem_(problem), log_(log), growing_(growing), bisection_(bisection) {}

  /// Solves from the problem's start on. `rejected`: a recording has shown that what seemed to be
  /// solved is not.
  End Solve(bool rejected);

 private:
  using Ids = std::vector<GroupId>;
  enum class Precision { kAhead, kExact };

  Sight Look(const Ids& since = {});
  Ids Note(const Sight& sight);
  bool IsSettled(const GroupId& id) const;
  Timeline Read(const Sight& sight) const;
  bool IsEnough(const Sight& sight, const GroupSight* miss) const;
  bool Reopens(const Sight& sight, const GroupSight* miss);
  End Recorded(const Sight& sight, const GroupSight* miss) const;
  std::optional<End> Polish(const Sight& sight);
  static bool SeesAll(const Sight& sight);
  bool MayBeAll(const Sight& sight) const;
  void Advance(const Sight& sight, const GroupSight& miss);
  Newton::End SolveBlock(const Ids& ids, const Sight* seen, double goal, Precision precision,
                         double unseen = 0, const GroupSight* shown = nullptr);
  static bool Blurs(const Sight& coarse, const GroupSight& exact, double goal);
  void Settle(const Ids& ids);
  bool Has(const Ids& ids, const Sight& sight) const;
  void Freeze(const Ids& ids, const Sight& sight);
  void SolveStrictly(const Ids& open);
  void SolveFirst(const Sight& sight, const GroupSight& miss, double goal, Precision how);
  void Verdict(const GroupSight& seen, const Ids& ids, double goal, Precision how);
  bool Waits(const GroupSight& group, const Sight& sight);
  bool TakeUp();
  void Grow(const GroupSight& group, Root root, const Sight& sight);
  void GiveUp(const Ids& ids);

  Problem& problem_;
  IterationLog& log_;
  Growing& growing_;
  Bisection& bisection_;
  bool rejected_ = false;
  double ahead_ = 0;           // The miss to which blocks are solved ahead.
  bool coarse_ = true;         // The next pass that looks may be.
  bool blurs_ = false;         // The last block was not solved, for its pass showed another motion.
  int corrections_ = 0;        // Of the last block that was solved ahead.
  std::optional<Sight> next_;  // What has solved a block, and went on to the next miss.
  struct Polished {
    double mu = 0;         // When it was polished last,
    bool settled = false;  // and whether that was the same as before.
  };
  std::map<GroupId, Polished> polished_;
  std::set<GroupId> waited_;      // Groups that have waited since one has grown.
  std::map<GroupId, int> tries_;  // Roots of a group that led to no solution of its block.
};

}  // namespace contact
