#pragma once

#include <vector>

#include "simulation/episode/groups.h"

namespace contact {

/// Whether a group that has ended misses its restitution by more than `tolerance`, relative, and it
/// was not found yet that it must.
bool Misses(const GroupSight& group, const Groups& groups, double tolerance);

/// The earliest groups that miss, with all that overlap them in time and that the search may
/// change, in order of start; of those that begin before `end` [s]. What happens later changes
/// nothing earlier, so they can be solved without the rest.
std::vector<GroupId> Front(const Sight& sight, const Groups& groups, double tolerance, double end);

/// The earliest group that misses by more than `tolerance`, and those of `front` that overlap it:
/// the part of a front to begin with where guesses are poor. Empty: none misses so much.
std::vector<GroupId> EarliestPart(const std::vector<GroupId>& front, const Sight& sight,
                                  double tolerance);

/// The last instant [s] at which no cycle runs, before the front begins, such that no group that
/// begins later may want to join one that ended before it; 0 if there is none.
double LastFinal(const Sight& sight, const std::vector<GroupId>& front);

/// Whether there is such a front and all of it has ended.
bool FrontIsComplete(const Sight& sight, const Groups& groups, double tolerance, double end);

/// Whether the first miss is seen with all that overlap it to their ends, or with more than `few`.
bool MissIsComplete(const Sight& sight, const Groups& groups, double tolerance, double end,
                    std::size_t few);

}  // namespace contact
