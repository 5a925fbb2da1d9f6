#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cli/link/recording.h"

namespace contact::cli {

/// A cycle with fewer samples than this has no visible shape.
inline constexpr std::ptrdiff_t kFewSamples = 10;

/// The number of samples within a cycle. `time` has the sample times [s], ascending.
std::ptrdiff_t SamplesIn(const v1::Cycle& cycle, const std::vector<double>& time);

/// A note on the cycles with fewer than kFewSamples samples, and the command that records more.
/// Empty if there are none, or no trajectory was recorded. Cycles that the end of the run cuts off
/// do not count.
std::string CoarseSampling(const Recording& recording);

}  // namespace contact::cli
