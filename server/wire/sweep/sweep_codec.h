#pragma once

#include <vector>

#include "contact/v1/scenario.pb.h"
#include "wire/scenario/scenario_codec.h"
#include "wire/sweep/sweep_axes.h"
#include "wire/sweep/sweep_metrics.h"

namespace contact {

/// A sweep as values, and what is wrong with the message it was read from.
struct DecodedSweep {
  /// The cells and their values.
  SweepAxes axes;
  /// The numbers to keep of each result.
  SweepMetrics metrics;
  /// Scenario of the first cell; empty if that is invalid.
  Scenario first;
  /// All rules broken, with paths from the sweep. With any, the other members are incomplete.
  std::vector<Violation> violations;
};

/// Reads a sweep and checks the rules written for Sweep in scenario.proto. Checks the base with the
/// values of the first cell; the values of the axes themselves may be out of range, since each cell
/// is checked again when it is computed.
DecodedSweep DecodeSweep(const v1::Sweep& message, const ScenarioLimits& limits = {});

}  // namespace contact
