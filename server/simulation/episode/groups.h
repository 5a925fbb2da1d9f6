#pragma once

#include <map>
#include <vector>

#include "simulation/episode/unknown.h"

namespace contact {

/// Whether a group has begun in this state, or is over.
bool HasBegun(const State& state, const GroupId& id);

/// The groups into which the cycles fall, and what is known of each. Groups only grow: nothing
/// parts what Merge has joined.
class Groups {
 public:
  /// The group with this id, made if there is none.
  Unknown& At(const GroupId& id);
  Unknown* Find(const GroupId& id);
  const Unknown* Find(const GroupId& id) const;

  /// Joins a group with the next of its encounter, as a pass has seen the two. It begins anew from
  /// the first guess of its first cycle.
  void Merge(const GroupSight& first, const GroupSight& next, Growth why);

  /// Forgets the groups that have begun in this state.
  void ForgetBegun(const State& state);
  std::map<GroupId, Unknown>& known() { return known_; }
  const std::map<GroupId, Unknown>& known() const { return known_; }

 private:
  std::map<GroupId, Unknown> known_;
};

}  // namespace contact
