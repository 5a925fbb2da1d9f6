#pragma once

#include <functional>
#include <vector>

#include "simulation/episode/groups.h"

namespace contact {

/// What a pass has shown, read in the order in which groups end: what a group misses depends only
/// on groups that begin before it ends.
class Timeline {
 public:
  /// `settled`: whether the μ of a group moves no more. `end`: of the run [s].
  Timeline(const Sight& sight, const Groups& groups, double end,
           std::function<bool(const GroupId&)> settled)
      : sight_(sight), groups_(groups), end_(end), settled_(std::move(settled)) {}

  /// The first group to end of those that miss by more than `least`; null: none.
  const GroupSight* FirstMiss(double least) const;
  /// Whether there is a first miss, and all that overlaps it, transitively, has ended, or is more
  /// than `few`.
  bool ShowsMiss(double least, std::size_t few) const;
  /// A group that misses with those that overlap it, transitively, end no later and are not
  /// settled; in the order of ends, the last `most`. Where no more than `few` overlap, those that
  /// end later are among them.
  std::vector<GroupId> Block(const GroupSight& miss, std::size_t few, std::size_t most) const;
  /// All that has ended and misses by no more than `most`, but what is settled and misses by no
  /// more than `least`; in the order of ends, as many as a pass can differentiate by.
  std::vector<GroupId> Solved(double least, double most) const;
  /// The instant [s] before which all that begins is final, if `miss`, or null, is the first miss.
  double FinalUntil(const GroupSight* miss) const;

 private:
  std::vector<GroupId> Overlapping(const GroupSight& miss, double until, bool settled) const;
  bool IsForeseen(const GroupSight& group, const GroupSight* miss) const;
  bool MayChange(const GroupSight& group) const;
  bool IsPoor(const GroupSight& group) const;

  const Sight& sight_;
  const Groups& groups_;
  double end_;
  std::function<bool(const GroupId&)> settled_;
};

}  // namespace contact
