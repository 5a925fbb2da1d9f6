#pragma once

#include <cstdint>
#include <limits>

#include "wire/scenario/scenario_codec.h"

namespace contact::cli {

/// Limits for checks in the client. What is too large is for the server to say; but the cells of a
/// sweep are laid out here, and must fit into memory.
inline constexpr ScenarioLimits kNoLimits{.max_bodies = std::numeric_limits<std::int32_t>::max(),
                                          .max_contacts = std::numeric_limits<std::int32_t>::max(),
                                          .max_samples = std::numeric_limits<std::int64_t>::max(),
                                          .max_cells = 1'000'000};

}  // namespace contact::cli
