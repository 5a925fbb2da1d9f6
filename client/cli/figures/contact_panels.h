#pragma once

#include "cli/figures/run_curves.h"

namespace contact::cli {

/// Panels about the contacts of a run, a colour each. They throw as RunCurves does.

/// Contact force and equivalent external force [N] over time [s], with μ/k above the peaks of the
/// first cycles that have enough samples to be seen.
Figure::Panel ForcePanel(const RunCurves& run);

/// Deformation velocity [m/s] over time [s].
Figure::Panel DeformationVelocityPanel(const RunCurves& run);

/// Contact force [N] over deformation [m], a loop for each cycle that has a sample.
Figure::Panel HysteresisPanel(const RunCurves& run);

/// The restitution coefficient that each cycle was asked for and the one that its group had, over
/// the place of the cycle in the ledger. Needs no trajectory.
Figure::Panel RestitutionPanel(const RunCurves& run);

}  // namespace contact::cli
