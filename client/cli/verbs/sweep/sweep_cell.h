#pragma once

#include <string>

#include "cli/base/style.h"
#include "cli/text/sweep/sweep_cells.h"
#include "contact/v1/job.pb.h"

namespace contact::cli {

/// The cell that `text` names: by its index, or by `FIELD=VALUE,…` with values to six digits. A
/// field is that of an axis, or its last part after a dot. Throws Failure (kUsage) unless exactly
/// one cell is named. The result is in `cells`.
const v1::SweepCell& FindCell(const v1::Sweep& sweep, const SweepCells& cells,
                              const std::string& text);

/// A cell of the sweep `job` as text: its state and why it failed, its values, its metrics.
std::string RenderCell(const v1::Job& job, const v1::SweepCell& cell, const Style& style);

/// The scenario of a cell: the base of the sweep with the values of the cell.
v1::Scenario ScenarioOf(const v1::Sweep& sweep, const v1::SweepCell& cell);

}  // namespace contact::cli
