#include "cli/figures/run/peak_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "cli/figures/run/sampling.h"

namespace contact::cli {
namespace {

constexpr std::size_t kMostLabels = 12;  // More would hide the curves.
constexpr double kApart = 0.02;  // Of the time shown: the height of a label that is upright.

using Cycles = std::vector<const v1::Cycle*>;

// The cycles whose peaks are in the figure and can be seen, that of the largest force first.
Cycles ByPeak(const RunCurves& run) {
  const std::vector<double>& time = run.Column("time");
  Cycles cycles;
  run.EachContact([&](const std::string& name, int) {
    run.EachCycle(name, [&](const v1::Cycle& cycle, int) {
      // NaN is in no window.
      const bool seen = run.InWindow(cycle.turn_time_s()) && SamplesIn(cycle, time) >= kFewSamples;
      if (seen) cycles.push_back(&cycle);
    });
  });
  std::ranges::stable_sort(cycles, std::greater(), &v1::Cycle::peak_force_n);
  return cycles;
}

double TimeShown(const Figure::Panel& panel) {
  double longest = 0;
  for (const Figure::Curve& curve : panel.curves) {
    if (!curve.x.empty()) longest = std::max(longest, curve.x.back() - curve.x.front());
  }
  return longest;
}

}  // namespace

void AddPeakLabels(const RunCurves& run, Figure::Panel* panel) {
  const double apart = kApart * TimeShown(*panel);
  Cycles chosen;
  for (const v1::Cycle* cycle : ByPeak(run)) {
    if (chosen.size() == kMostLabels) break;
    const bool crowded = std::ranges::any_of(chosen, [&](const v1::Cycle* other) {
      return std::abs(other->turn_time_s() - cycle->turn_time_s()) < apart;
    });
    if (!crowded) chosen.push_back(cycle);
  }
  std::ranges::sort(chosen, {}, &v1::Cycle::turn_time_s);
  for (const v1::Cycle* cycle : chosen) {
    panel->labels.push_back({cycle->turn_time_s(), cycle->peak_force_n(),
                             fmt::format("μ/k = {:.4g} s/m", cycle->mu_over_k_s_per_m())});
  }
}

}  // namespace contact::cli
