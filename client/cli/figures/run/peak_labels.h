#pragma once

#include "cli/figures/run/run_curves.h"

namespace contact::cli {

/// Labels the largest peaks of the contact force in a panel over time with the μ/k [s/m] of their
/// cycles: at most 12, so far apart that one can read them, and none of a cycle with too few
/// samples for its peak to be seen. Throws as RunCurves does.
void AddPeakLabels(const RunCurves& run, Figure::Panel* panel);

}  // namespace contact::cli
