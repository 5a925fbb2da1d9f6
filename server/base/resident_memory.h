#pragma once

#include <cstdint>

namespace contact {

/// Bytes of memory that this process takes now, as the system counts them; 0 if it does not tell.
std::int64_t ResidentMemory();

}  // namespace contact
