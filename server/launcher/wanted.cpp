#include "launcher/wanted.h"

#include <algorithm>
#include <cstdint>

namespace contact::launcher {

int Wanted(const Demand& demand, const Limits& limits) {
  // So many jobs need every worker; more need not be counted, and could not be added up.
  const std::int64_t most = std::int64_t{limits.max_workers} * limits.threads;
  const std::int64_t jobs = std::min(std::clamp<std::int64_t>(demand.queued, 0, most) +
                                         std::clamp<std::int64_t>(demand.running, 0, most),
                                     most);
  const auto processes = static_cast<int>((jobs + limits.threads - 1) / limits.threads);
  return std::clamp(processes, limits.min_workers, limits.max_workers);
}

}  // namespace contact::launcher
