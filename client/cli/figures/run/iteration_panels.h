#pragma once

#include <vector>

#include "cli/figures/figure.h"
#include "contact/v1/event.pb.h"

namespace contact::cli {

/// μ [N·s/m^(n+1)] and |residual| over the passes of the episode that took the most passes, a curve
/// for each cycle. A residual of zero, which has no logarithm, is drawn at 1e-17. Throws Failure
/// (kUsage) without iterations.
std::vector<Figure::Panel> IterationPanels(const std::vector<v1::Iteration>& iterations);

}  // namespace contact::cli
