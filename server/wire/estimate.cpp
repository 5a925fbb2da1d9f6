#include "wire/estimate.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "simulation/forecast/run_estimate.h"

namespace contact {
namespace {

std::int64_t Whole(double value) {
  constexpr double kMost = 9e18;
  return static_cast<std::int64_t>(std::clamp(value, 0.0, kMost));
}

void SetSeconds(double seconds, google::protobuf::Duration* duration) {
  constexpr double kMost = 3e11;  // Of the type, in s.
  const double whole = std::floor(std::min(seconds, kMost));
  duration->set_seconds(static_cast<std::int64_t>(whole));
  if (seconds < kMost) duration->set_nanos(static_cast<std::int32_t>((seconds - whole) * 1e9));
}

v1::Estimate Encode(const RunEstimate& run) {
  v1::Estimate estimate;
  if (run.steps) estimate.set_steps(Whole(*run.steps));
  estimate.set_samples(Whole(run.samples));
  estimate.set_output_bytes(Whole(run.sample_bytes + run.ledger_bytes));
  estimate.set_memory_bytes(Whole(run.memory_bytes));
  if (run.solve_seconds) {
    SetSeconds(*run.solve_seconds + run.sample_seconds, estimate.mutable_wall_time());
  }
  return estimate;
}

}  // namespace

v1::Estimate EstimateRun(const Scenario& scenario) { return Encode(EstimateRunOf(scenario)); }

std::int64_t FixedMemory(const Scenario& scenario) {
  return Whole(EstimateRunOf(scenario).fixed_memory);
}

std::int64_t FixedMemory(const v1::Sweep& sweep, const DecodedSweep& plan) {
  const RunEstimate one = EstimateRunOf(plan.first);
  return Whole(one.fixed_memory + (sweep.keep_trajectories_size() > 0 ? one.sample_memory : 0));
}

v1::Estimate EstimateSweep(const v1::Sweep& sweep, const DecodedSweep& plan) {
  constexpr double kSweepBytes = 600;  // States, attempt and progress of the job.
  constexpr double kCellBytes = 60;    // The event of a cell, without its numbers.
  constexpr double kNumberBytes = 8;   // A value or metric of a cell.
  const double cells = plan.axes.cells();
  const double kept = sweep.keep_trajectories_size();
  const RunEstimate one = EstimateRunOf(plan.first);
  const double numbers = sweep.axes_size() + sweep.metrics_size();
  RunEstimate all;
  if (one.steps) all.steps = cells * std::floor(*one.steps);
  all.samples = kept * one.samples;
  all.sample_bytes = kept * one.sample_bytes;
  all.ledger_bytes = kSweepBytes + cells * (kCellBytes + kNumberBytes * numbers);
  all.memory_bytes = one.memory_bytes + (kept > 0 ? one.sample_memory : 0);
  if (one.solve_seconds) all.solve_seconds = cells * *one.solve_seconds;
  all.sample_seconds = (plan.metrics.need_samples() ? cells : kept) * one.sample_seconds;
  return Encode(all);
}

}  // namespace contact
