#include "cli/figures/run/sampling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "base/spelling.h"
#include "cli/base/number.h"

namespace contact::cli {

std::ptrdiff_t SamplesIn(const v1::Cycle& cycle, const std::vector<double>& time) {
  return std::ranges::upper_bound(time, cycle.end_time_s()) -
         std::ranges::lower_bound(time, cycle.start_time_s());
}

std::string CoarseSampling(const Recording& recording) {
  constexpr int kEnoughSamples = 100;
  const SampleColumn* time = recording.Find("time");
  if (time == nullptr) return "";
  std::int64_t coarse = 0;
  for (const v1::Cycle& cycle : recording.job.cycles()) {
    if (cycle.end() == v1::Cycle::RUN_END) continue;
    if (SamplesIn(cycle, time->values) < kFewSamples) ++coarse;
  }
  if (coarse == 0) return "";
  return fmt::format(
      "{} fewer than {} samples, too few to show. For more:\n"
      "  contactctl run --like {} --set output.samples_per_contact={}",
      Count(coarse, "contact cycle has", "contact cycles have"), kFewSamples, recording.job.name(),
      kEnoughSamples);
}

}  // namespace contact::cli
