#pragma once

#include <vector>

#include "contact/v1/scenario.pb.h"
#include "wire/scenario_codec.h"
#include "wire/sweep_axes.h"
#include "wire/sweep_metrics.h"

namespace contact {

struct DecodedSweep {
  SweepAxes axes;
  SweepMetrics metrics;
  Scenario first;                     ///< Of the first cell; empty if that is invalid.
  std::vector<Violation> violations;  ///< Paths from the sweep. With any, the rest is incomplete.
};

/// Checks the rules written for Sweep in scenario.proto. The values of single cells are not among
/// them, but for what the first cell shows of the base.
DecodedSweep DecodeSweep(const v1::Sweep& message, const ScenarioLimits& limits = {});

}  // namespace contact
