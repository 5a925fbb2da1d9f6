#pragma once

#include <cstdint>
#include <vector>

#include "contact/v1/scenario.pb.h"
#include "simulation/model/scenario.h"
#include "wire/violation.h"

namespace contact {

/// What a scenario may hold at most; checked before anything is allocated for it.
struct ScenarioLimits {
  std::int32_t max_bodies = 20'000;
  std::int32_t max_contacts = 20'000;     ///< After neighbours are expanded.
  std::int64_t max_samples = 10'000'000;  ///< Rows of the recorded trajectory.
  std::int32_t max_cells = 100'000;       ///< Of a sweep.
};

struct DecodedScenario {
  Scenario scenario;                  ///< Complete only if there are no violations.
  std::vector<Violation> violations;  ///< All of them, in field order; at most 100.
};

/// Reads a scenario from the wire: fills defaults, then checks every rule written in
/// scenario.proto. The one place where input is checked: server and command line both call it.
DecodedScenario DecodeScenario(const v1::Scenario& message, const ScenarioLimits& limits = {});

}  // namespace contact
