#include "launcher/wanted.h"

#include <algorithm>
#include <cstdint>

namespace contact::launcher {

int Wanted(const Demand& demand, const Limits& limits) {
  // So many jobs need every worker; more need not be counted, and could not be added up.
  const std::int64_t most = std::int64_t{limits.max_workers} * limits.threads;
  std::int64_t work = 0;
  for (const std::int64_t part : {demand.queued, demand.running, demand.cells}) {
    work += std::clamp<std::int64_t>(part, 0, most);
  }
  work = std::min(work, most);
  const auto processes = static_cast<int>((work + limits.threads - 1) / limits.threads);
  return std::clamp(processes, limits.min_workers, limits.max_workers);
}

}  // namespace contact::launcher
