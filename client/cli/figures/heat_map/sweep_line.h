#pragma once

#include "cli/figures/figure.h"
#include "cli/text/sweep/sweep_cells.h"
#include "contact/v1/job.pb.h"

namespace contact::cli {

/// One metric of a sweep over one axis: a line through the cells in the order of their values,
/// broken where a cell failed or has no value that is known, with crosses where a cell did not
/// converge. With `log` the metric is on a logarithmic axis; the axis of a sweep with a `log` range
/// always is. `metric` is the place of the metric among those of the sweep. Throws Failure (kUsage)
/// if no cell has a value to show. The sweep has one axis.
Figure SweepLineFigure(const v1::Job& job, const SweepCells& cells, int metric, bool log);

}  // namespace contact::cli
