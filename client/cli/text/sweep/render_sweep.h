#pragma once

#include <string>
#include <vector>

#include "cli/base/style.h"
#include "cli/base/table.h"
#include "cli/text/sweep/sweep_cells.h"
#include "contact/v1/job.pb.h"

namespace contact::cli {

/// A sweep for people: its state, then a line a cell; of many cells the middle is left out.
std::string RenderSweep(const v1::Job& job, const SweepCells& cells, const Style& style);

/// All cells as CSV: cell, axes, metrics, state, convergence, message. A metric that is no known
/// number is `nan`; the message says why, see UnknownMetrics. `columns` selects columns by name,
/// see Table::Csv; empty: all.
std::string SweepCsv(const v1::Sweep& sweep, const SweepCells& cells,
                     const std::vector<std::string>& columns = {});

/// The columns of RenderSweep, for --columns and its completion.
std::vector<Table::Column> SweepColumns(const v1::Sweep& sweep);

/// The columns of SweepCsv, for --columns and its completion.
std::vector<Table::Column> SweepCsvColumns(const v1::Sweep& sweep);

/// One JSON document with `job` and `cells`, a line a cell.
std::string SweepJson(const v1::Job& job, const SweepCells& cells);

}  // namespace contact::cli
