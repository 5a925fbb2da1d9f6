#pragma once

namespace contact {

/// Groups by whose μ a pass differentiates at most: each costs memory, and time of every step.
/// Those that begin later are solved after these. No group of 3,000 random scenarios is the 200th.
inline constexpr int kMostColumns = 240;

}  // namespace contact
