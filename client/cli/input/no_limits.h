#pragma once

#include <cstdint>
#include <limits>

#include "wire/scenario/scenario_codec.h"

namespace contact::cli {

/// Limits for checks in the client, which leave limits on size to the server.
inline constexpr ScenarioLimits kNoLimits{.max_bodies = std::numeric_limits<std::int32_t>::max(),
                                          .max_contacts = std::numeric_limits<std::int32_t>::max(),
                                          .max_samples = std::numeric_limits<std::int64_t>::max(),
                                          .max_cells = std::numeric_limits<std::int32_t>::max()};

}  // namespace contact::cli
