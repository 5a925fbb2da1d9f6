#pragma once

#include <string>

#include "cli/link/client.h"
#include "cli/settings/settings.h"
#include "cli/text/sweep/render_sweep.h"

namespace contact::cli {

/// Waits for the end of a sweep and fetches its cells. Throws CallFailure, and Failure (kTimeout,
/// kInterrupted) when the wait ends first.
SweepCells ReadCells(Client& client, const v1::Job& job, const Settings& settings);

/// The cell with this number, or with the values of `FIELD=VALUE,…` to six digits; the fields are
/// axes, or what these end with after a dot. Throws Failure (kUsage) unless that is one cell.
const v1::SweepCell& FindCell(const v1::Sweep& sweep, const SweepCells& cells,
                              const std::string& text);

/// A cell for people: what became of it and why, its values, its metrics.
std::string RenderCell(const v1::Job& job, const v1::SweepCell& cell, const Style& style);

/// The base with the values of the cell.
v1::Scenario ScenarioOf(const v1::Sweep& sweep, const v1::SweepCell& cell);

}  // namespace contact::cli
