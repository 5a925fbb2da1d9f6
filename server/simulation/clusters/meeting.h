#pragma once

#include <optional>
#include <vector>

#include "simulation/clusters/blocks.h"
#include "simulation/clusters/world.h"

namespace contact {

/// Two bodies that touch, of which a piece has only one.
struct Meeting {
  double time = 0;  ///< No later than they touch [s].
  int inside = kNone, outside = kNone;
};

/// The groups that wait together at t = 0: bodies in blocks, pressed against each other, or not in
/// flight yet. All other bodies fly.
std::vector<Waiting> GroupsAtStart(const World& world, const Blocks& blocks);

/// The groups that wait together when a piece has ended: joined by contacts in touch, by those that
/// will soon be, and in blocks. All other bodies fly.
std::vector<Waiting> GroupsAfter(const World& world, const Piece& piece, const Blocks& blocks);

/// The first meeting of a body of a piece with another one, as far as that one's motion is known:
/// in the piece, and in the flights that follow until the other's last piece has ended.
std::optional<Meeting> FirstMeeting(const World& world, const Piece& piece,
                                    const std::vector<Waiting>& groups);

}  // namespace contact
