#pragma once

#include <map>
#include <vector>

#include "simulation/episode/unknown.h"

namespace contact {

/// Whether a group has begun in this state, or is over.
bool HasBegun(const State& state, const GroupId& id);
/// The group of a contact that has begun last.
GroupId LastGroup(const ContactState& contact);

/// The groups into which the cycles fall, and what is known of each. Groups only grow: nothing
/// parts what Merge has joined.
class Groups {
 public:
  /// The group with this id, made if there is none.
  Unknown& At(const GroupId& id);
  Unknown* Find(const GroupId& id);
  const Unknown* Find(const GroupId& id) const;

  /// Whether a group, as a pass has seen it, misses its restitution by more than this, relative, so
  /// that the search is to find its μ.
  bool Misses(const GroupSight& group, double tolerance) const;

  /// Joins a group with the next of its encounter, as a pass has seen the two. It begins anew from
  /// the first guess of its first cycle.
  void Merge(const GroupSight& first, const GroupSight& next, Growth why);

  /// The rest that follows a group ends at this instant [s], or earlier if that was noted before.
  void NoteRestEnd(const GroupId& before, double time);
  /// When the rest that follows a group ends [s]; infinite if nothing is known of that.
  double RestEnd(const GroupId& before) const;
  std::map<GroupId, double>& rest_ends() { return rest_ends_; }
  const std::map<GroupId, double>& rest_ends() const { return rest_ends_; }

  /// Notes since when groups overlap one that the end of the run cuts, or a group that does, or end
  /// at the trough where such a group begins: with a later end their μ may be others. `sight` has
  /// seen the run to its end [s].
  void NoteCut(const Sight& sight, double end);
  /// That instant [s]; infinite if there is none.
  double cut_since() const { return cut_since_; }
  void set_cut_since(double time) { cut_since_ = time; }

  /// Forgets the groups that have begun in this state, and rests that are over.
  void ForgetBegun(const State& state);
  std::map<GroupId, Unknown>& known() { return known_; }
  const std::map<GroupId, Unknown>& known() const { return known_; }

 private:
  std::map<GroupId, Unknown> known_;
  std::map<GroupId, double> rest_ends_;  // By the group before the rest.
  double cut_since_ = kNever;
};

}  // namespace contact
