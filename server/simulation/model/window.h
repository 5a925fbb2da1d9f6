#pragma once

#include <algorithm>
#include <cstddef>

namespace contact {

// A window: the cycles whose μ are solved together, README.md of simulation/, (N6). It may hold
// every contact of a touching row once and some again, but no more than can be solved together in
// bounded time and memory.

/// Cycles that a window may hold beyond one for each contact.
inline constexpr int kSpareWindowCycles = 140;
/// Cycles that a window holds at most, however many contacts there are.
inline constexpr int kMostWindowCycles = 240;

/// The most cycles that a window holds in a scenario with so many contacts.
constexpr int MostWindowCycles(std::size_t contacts) {
  return static_cast<int>(std::min(contacts + kSpareWindowCycles, std::size_t{kMostWindowCycles}));
}

}  // namespace contact
