#pragma once

#include "contact/v1/event.pb.h"
#include "contact/v1/job.pb.h"
#include "simulation/model/ledger.h"
#include "simulation/model/scenario.h"

namespace contact {

/// Encode writes a row of the ledger as a message of the contract. `scenario` is the one that runs;
/// names of contacts come from it.

/// A cycle.
v1::Cycle Encode(const Scenario& scenario, const Cycle& cycle);
/// A group of cycles.
v1::Group Encode(const Scenario& scenario, const Group& group);
/// A group of the search, as Observer::OnGrowth has it.
v1::GroupGrowth EncodeGrowth(const Scenario& scenario, const Group& group);

}  // namespace contact
