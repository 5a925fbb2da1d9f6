#pragma once

#include <cstdint>
#include <vector>

#include "contact/v1/scenario.pb.h"
#include "simulation/model/scenario.h"
#include "wire/rules/violation.h"

namespace contact {

/// What a scenario may hold at most; checked before anything is allocated for it.
struct ScenarioLimits {
  std::int32_t max_bodies = 20'000;
  std::int32_t max_contacts =
      20'000;  ///< After neighbours are expanded; the same for supports and loads.
  std::int64_t max_samples = 10'000'000;  ///< Rows of the recorded trajectory.
  std::int32_t max_cells = 100'000;       ///< Of a sweep.
};

/// A scenario as values, and what is wrong with the message it was read from.
struct DecodedScenario {
  Scenario scenario;                  ///< Complete only if there are no violations.
  std::vector<Violation> violations;  ///< All of them, in field order; at most 100.
};

/// Reads a scenario from the wire: fills defaults and checks every rule written in scenario.proto.
/// Server and command line both call it; input is checked nowhere else. Never throws. Safe to call
/// from any thread.
DecodedScenario DecodeScenario(const v1::Scenario& message, const ScenarioLimits& limits = {});

}  // namespace contact
