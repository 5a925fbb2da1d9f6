#pragma once

#include <algorithm>
#include <cstddef>

namespace contact {

// A window: the cycles whose μ are solved together, README.md of simulation/, (N6). It may hold
// every contact of a touching row once and some again, but no more than can be solved together in
// bounded time and memory.
inline constexpr int kFewestWindowCycles = 16;  ///< Whatever the number of contacts.
inline constexpr int kSpareWindowCycles = 60;   ///< More than there are contacts.
inline constexpr int kMostWindowCycles = 120;   ///< Whatever the number of contacts.

/// The most cycles that a window holds in a scenario with so many contacts.
constexpr int MostWindowCycles(std::size_t contacts) {
  return static_cast<int>(std::clamp(contacts + kSpareWindowCycles,
                                     std::size_t{kFewestWindowCycles},
                                     std::size_t{kMostWindowCycles}));
}

}  // namespace contact
