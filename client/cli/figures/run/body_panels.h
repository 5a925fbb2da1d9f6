#pragma once

#include "cli/figures/run/run_curves.h"

namespace contact::cli {

/// Panels about the bodies of a run over time [s], a colour each, with marks where the cycles of
/// their contacts start and end. They throw as RunCurves does.

/// Positions [m]; a dotted line is where the centre of a body stands when the body touches its
/// wall.
Figure::Panel PositionPanel(const RunCurves& run);

/// Positions less those at the start of the run [m].
Figure::Panel DisplacementPanel(const RunCurves& run);

/// Velocities [m/s].
Figure::Panel VelocityPanel(const RunCurves& run);

}  // namespace contact::cli
