#pragma once

#include <string>

#include "cli/base/style.h"
#include "contact/v1/event.pb.h"
#include "contact/v1/job.pb.h"

namespace contact::cli {

/// The groups of a job of which the ledger does not tell all, as a table with a line for each that
/// has no μ that gives its ε: those of several cycles, and those that are JUMP, LIMITED,
/// INFEASIBLE, RELEASED or UNFINISHED. Empty without such groups.
std::string RenderGroups(const v1::Job& job, const Style& style);

/// Whether RenderGroups shows the group.
bool IsNotable(const v1::Group& group);

/// The cycles of a group: `2`, or `2 to 4`.
std::string CyclesOf(const v1::Group& group);

/// What the search for a μ that does not exist has reached: `it jumps from 0.71 at μ = 2e8 to 0.64
/// at μ = 2.1e8`; of a RELEASED group what it gives back. Empty unless the group is JUMP, LIMITED,
/// INFEASIBLE or RELEASED.
std::string Certificate(const v1::Group& group);

/// A growth in a line: `B1-B2 cycle 2 and the next share one μ: …`.
std::string GrowthLine(const v1::GroupGrowth& growth);

}  // namespace contact::cli
