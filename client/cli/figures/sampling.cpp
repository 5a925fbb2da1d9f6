#include "cli/figures/sampling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "cli/base/number.h"

namespace contact::cli {

std::ptrdiff_t SamplesIn(const v1::Cycle& cycle, const std::vector<double>& time) {
  return std::ranges::upper_bound(time, cycle.end_time_s()) -
         std::ranges::lower_bound(time, cycle.start_time_s());
}

std::string CoarseSampling(const Recording& recording) {
  constexpr double kEnoughSamples = 50;
  const SampleColumn* time = recording.Find("time");
  if (time == nullptr) return "";
  double shortest = std::numeric_limits<double>::infinity();
  std::int64_t coarse = 0;
  for (const v1::Cycle& cycle : recording.job.cycles()) {
    if (cycle.end() == v1::Cycle::RUN_END) continue;
    if (SamplesIn(cycle, time->values) < kFewSamples) ++coarse;
    shortest = std::min(shortest, cycle.end_time_s() - cycle.start_time_s());
  }
  if (coarse == 0) return "";
  return fmt::format(
      "{} fewer than {} samples, too few to show. For more:\n"
      "  contactctl run --like {} --set output.sample_interval_s={:.0e}",
      Count(coarse, "contact cycle has", "contact cycles have"), kFewSamples, recording.job.name(),
      shortest / kEnoughSamples);
}

}  // namespace contact::cli
