#pragma once

#include <vector>

#include "contact/v1/scenario.pb.h"
#include "wire/scenario/scenario_codec.h"
#include "wire/sweep/sweep_axes.h"
#include "wire/sweep/sweep_metrics.h"

namespace contact {

/// A sweep as values, and what is wrong with the message it was read from.
struct DecodedSweep {
  SweepAxes axes;                     ///< The cells and their values.
  SweepMetrics metrics;               ///< The numbers to keep of each result.
  Scenario first;                     ///< Scenario of the first cell; empty if that is invalid.
  std::vector<Violation> violations;  ///< Paths from the sweep. With any, the rest is incomplete.
};

/// Reads a sweep and checks the rules written for Sweep in scenario.proto. Checks the base with the
/// values of the first cell; the values of the axes themselves may be out of range, since each cell
/// is checked again when it is computed.
DecodedSweep DecodeSweep(const v1::Sweep& message, const ScenarioLimits& limits = {});

}  // namespace contact
