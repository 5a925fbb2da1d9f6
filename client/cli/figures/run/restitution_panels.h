#pragma once

#include <vector>

#include "cli/figures/run/run_curves.h"

namespace contact::cli {

/// Over the place of each cycle in the ledger: the restitution coefficient ε that it was asked for
/// (o) and the one that its group had (×); below them, if any was asked for, |Δε|/ε, which tells
/// apart what coincides above. An error of zero, which has no logarithm, is drawn at 1e-17. Needs
/// no trajectory.
std::vector<Figure::Panel> RestitutionPanels(const RunCurves& run);

}  // namespace contact::cli
