#pragma once

#include <string>
#include <vector>

#include "cli/base/style.h"
#include "cli/base/table.h"
#include "cli/text/sweep_cells.h"
#include "contact/v1/job.pb.h"

namespace contact::cli {

/// A sweep for people: state, and a line for each cell, the middle of many left out.
std::string RenderSweep(const v1::Job& job, const SweepCells& cells, const Style& style);

/// A metric over two axes as shades, the first axis down, the second across. Cells that did not
/// converge carry a `!`, those that failed are `××`. With `log` the shades are of its logarithm.
/// Empty unless the sweep is a grid of two axes that fits into the terminal, and has this metric.
std::string HeatMap(const v1::Sweep& sweep, const SweepCells& cells, int metric, const Style& style,
                    bool log = false);

/// All cells as CSV: cell, axes, metrics, state, convergence, message; or the columns of these
/// names, which Table::Csv knows.
std::string SweepCsv(const v1::Sweep& sweep, const SweepCells& cells,
                     const std::vector<std::string>& columns = {});

/// The columns of the table, and those of CSV.
std::vector<Table::Column> SweepColumns(const v1::Sweep& sweep);
std::vector<Table::Column> SweepCsvColumns(const v1::Sweep& sweep);

/// The job and all cells as one JSON document.
std::string SweepJson(const v1::Job& job, const SweepCells& cells);

}  // namespace contact::cli
