#pragma once

#include "cli/figures/run/run_curves.h"

namespace contact::cli {

/// Panels about the contacts of a run, a colour each. They throw as RunCurves does.

/// Contact force and equivalent external force [N] over time [s], with μ/k above the largest peaks
/// of cycles that have enough samples to be seen.
Figure::Panel ForcePanel(const RunCurves& run);

/// Deformation velocity [m/s] over time [s].
Figure::Panel DeformationVelocityPanel(const RunCurves& run);

/// Contact force [N] over deformation [m], a loop for each cycle that has a sample. It begins and
/// ends where the ledger says that the cycle does.
Figure::Panel HysteresisPanel(const RunCurves& run);

}  // namespace contact::cli
