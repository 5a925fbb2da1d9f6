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
  /// Contacts after neighbours are expanded. Supports and loads have the same limit.
  std::int32_t max_contacts = 20'000;
  /// Rows of the recorded trajectory.
  std::int64_t max_samples = 10'000'000;
  /// Cells of a sweep.
  std::int32_t max_cells = 100'000;
};

/// A scenario as values, and what is wrong with the message it was read from.
struct DecodedScenario {
  /// Complete only if there are no violations.
  Scenario scenario;
  /// All rules broken, in the order of the fields; at most Rules::kMostViolations.
  std::vector<Violation> violations;
};

/// Reads a scenario from the wire: fills defaults and checks every rule written in scenario.proto.
/// Server and command line both call it; input is checked nowhere else. Never throws. Safe to call
/// from any thread.
DecodedScenario DecodeScenario(const v1::Scenario& message, const ScenarioLimits& limits = {});

}  // namespace contact
